import { describe, expect, it } from "vitest";
import { aDetector } from "./aDetector";
import { changesBetween, sentence } from "./changes";

const told = (before: Parameters<typeof changesBetween>[0], after: typeof before): string[] =>
  changesBetween(before, after).map((change) => sentence(change).replaceAll("\u00a0", " "));

describe("changesBetween", () => {
  const force = aDetector();
  const lvdt = aDetector({ name: "lvdt", quantity: "lvdt", comparison: "above", threshold: 0.5 });

  it("says what is other in the units of the control room", () => {
    expect(told([force], [{ ...force, threshold: 50e3, action: "stop", persistence_s: 0.01 }])).toEqual([
      "Force: limit 50.000 kN, was 55.000 kN",
      "Force: persistence 10 ms, was at once",
      "Force: action Stop, was Shut down",
    ]);
    expect(told([force], [{ ...force, comparison: "outside", low: -1e3 }])).toContain("Force: lower limit −1.000 kN, was none");
  });

  it("tells additions, removals and another order, which decides who is first of two in one tick", () => {
    expect(told([force], [force, lvdt])).toEqual(["LVDT: added"]);
    expect(told([force, lvdt], [force])).toEqual(["LVDT: removed"]);
    expect(told([force, lvdt], [lvdt, force])).toEqual(["The table: another order"]);
  });

  it("finds nothing where nothing differs", () => {
    expect(told([force, lvdt], [force, { ...lvdt, armed: [...lvdt.armed].reverse() }])).toEqual([]);
  });
});
