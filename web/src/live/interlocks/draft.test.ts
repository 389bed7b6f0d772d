import { describe, expect, it } from "vitest";
import { aDetector } from "./aDetector";
import { added, changed, duplicated, freeName, moved, removed } from "./draft";

describe("a draft", () => {
  const table = [aDetector(), aDetector({ name: "force_2" }), aDetector({ name: "lvdt" })];
  const names = (list: readonly { readonly name: string }[]): string[] => list.map(({ name }) => name);

  it("gives every detector a name of its own", () => {
    expect(freeName(table, "force")).toBe("force_3");
    expect(names(duplicated(table, 0))).toEqual(["force", "force_3", "force_2", "lvdt"]);
    expect(names(added(added(table))).slice(3)).toEqual(["new_detector", "new_detector_2"]);
  });

  it("moves within the table and no farther", () => {
    expect(names(moved(table, 2, -1))).toEqual(["force", "lvdt", "force_2"]);
    expect(moved(table, 0, -1)).toBe(table);
    expect(moved(table, 2, 1)).toBe(table);
    expect(names(removed(table, 1))).toEqual(["force", "lvdt"]);
  });

  it("keeps what belongs to the chosen form, and begins it with something", () => {
    const ahead = changed(table, 0, { form: "look_ahead" })[0]!;
    expect(ahead.horizon_s).toBeGreaterThan(0);
    expect(changed([ahead], 0, { form: "value" })[0]).toMatchObject({ horizon_s: null, smoothing_s: null });
    const band = changed(table, 0, { comparison: "outside" })[0]!;
    expect(band.low).toBeLessThan(band.threshold);
    expect(changed([band], 0, { comparison: "above" })[0]!.low).toBeNull();
  });

  it("latches what takes the load off", () => {
    const hint = changed(table, 0, { action: "indicate", latching: false })[0]!;
    expect(hint.latching).toBe(false);
    expect(changed([hint], 0, { action: "stop" })[0]!.latching).toBe(true);
  });
});
