import { describe, expect, it } from "vitest";
import { yamlOf } from "./yaml";

describe("yamlOf", () => {
  it("writes a definition as people write it", () => {
    const definition = {
      schema: 1,
      name: "Layers of load at 100 Hz",
      description: "Twice: up, then down",
      blocks: [
        { kind: "hold", force_n: 0, seconds_s: 1.5 },
        { kind: "layers", layers: [{ mean_n: 0, cycles: 5 }, { mean_n: -1e4, cycles: 2 }], repeats: 2 },
      ],
      acceptance: [],
      rates: [1, 2.5],
      limit: null,
    };
    expect(yamlOf(definition)).toBe(
      [
        "schema: 1",
        "name: Layers of load at 100 Hz",
        'description: "Twice: up, then down"',
        "blocks:",
        "  - {kind: hold, force_n: 0, seconds_s: 1.5}",
        "  - kind: layers",
        "    layers:",
        "      - {mean_n: 0, cycles: 5}",
        "      - {mean_n: -10000, cycles: 2}",
        "    repeats: 2",
        "acceptance: []",
        "rates: [1, 2.5]",
        "limit: null",
        "",
      ].join("\n"),
    );
  });

  it("quotes what would be read as something else", () => {
    expect(yamlOf({ a: "true", b: "1.5", c: "", d: "x: y", e: " x", f: "line\nline" })).toBe(
      '{a: "true", b: "1.5", c: "", d: "x: y", e: " x", f: "line\\nline"}\n',
    );
  });
});
