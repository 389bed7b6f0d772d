import { describe, expect, it } from "vitest";
import openapi from "../../gen/openapi.json?raw";
import { calibrationFields, changesBetween, ITEMS, MODEL, read, SENSORS, valueAt, withValue } from "./fields";
import type { Configuration } from "./types";

interface Schema {
  readonly $ref?: string;
  readonly properties?: Readonly<Record<string, Schema>>;
  readonly allOf?: readonly Schema[];
}
const described = JSON.parse(openapi) as {
  components: { schemas: Record<string, Schema> };
};

/** Every value of the document, as the server describes it. */
function paths(schema: Schema, before = ""): string[] {
  const ref = schema.$ref ?? schema.allOf?.[0]?.$ref;
  if (ref !== undefined) return paths(described.components.schemas[ref.split("/").at(-1)!]!, before);
  if (schema.properties === undefined) return [before.slice(1)];
  return Object.entries(schema.properties).flatMap(([name, inner]) => paths(inner, `${before}.${name}`));
}

const known = [
  ...ITEMS.flatMap(({ fields }) => fields),
  ...SENSORS.flatMap(([sensor, , unit]) => calibrationFields(sensor, unit)),
  ...MODEL.flatMap(({ fields }) => fields),
];
const document = { limits: { force_n: 5e4, displacement_m: null }, model: { structure: { k_pl: 1.5e8 } } } as unknown as Configuration;
const field = (path: string): (typeof known)[number] => known.find((one) => one.path === path)!;

describe("the fields of the rig configuration", () => {
  it("are all that the server describes, and no others", () => {
    const described_ = paths(described.components.schemas["RigConfiguration"]!).filter(
      (path) => path !== "model.name" && !/^calibrations\.\w+\.(name|notes)$/.test(path),
    );
    expect([...known.map(({ path }) => path)].sort()).toEqual([...described_].sort());
  });

  it("are changed one by one, and what differs is listed", () => {
    const changed = withValue(document, "model.structure.k_pl", 1.4e8);
    expect(valueAt(changed, "model.structure.k_pl")).toBe(1.4e8);
    expect(valueAt(document, "model.structure.k_pl")).toBe(1.5e8);
    expect(changesBetween(document, changed).map(({ field: { path }, before, after }) => [path, before, after])).toEqual([
      ["model.structure.k_pl", 1.5e8, 1.4e8],
    ]);
  });

  it("are read as they are meant, and not where they mean nothing", () => {
    expect(read(field("model.structure.k_pl"), "1.4e8")).toBe(1.4e8);
    expect(read(field("model.servovalve.null_m"), "−1e-6")).toBe(-1e-6);
    expect(read(field("model.structure.k_pl"), "stiff")).toBeUndefined();
    expect(read(field("model.structure.k_pl"), "")).toBeUndefined();
    expect(read(field("limits.force_n"), "")).toBeNull();
    expect(read(field("rig.serial_number"), " A-1 ")).toBe("A-1");
  });
});
