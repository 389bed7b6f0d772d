import { describe, expect, it } from "vitest";
import { askedOf, comparedOf, queryOf, toggled, withBaseline, without, type Compared } from "./query";

const ALL: Compared = {
  ids: [7, 3, 9],
  channel: "displacement_m",
  align: "block",
  block: 2,
  toleranceAbs: 25.5,
  toleranceRel: 0.02,
  window: { from: -0.5, to: 1.25025 },
  hidden: [3],
  pane: "trend",
  measurement: "phase_deg",
};

describe("what is compared", () => {
  it("is all in the address", () => {
    expect(comparedOf(queryOf(ALL))).toEqual(ALL);
  });

  it("needs few words where nothing was chosen", () => {
    expect(queryOf(comparedOf("ids=1,2"))).toBe("ids=1,2");
  });

  it("takes what makes no sense for nothing", () => {
    const found = comparedOf("ids=2,x,2,-1,5&align=sideways&block=-3&abs=many&rel=&from=3&to=2&pane=kitchen");
    expect(found.ids).toEqual([2, 5]);
    expect([found.align, found.block, found.toleranceAbs, found.toleranceRel]).toEqual(["time", null, null, null]);
    expect([found.window, found.pane]).toEqual([null, "measurements"]);
  });

  it("has at most eight runs", () => {
    expect(comparedOf("ids=1,2,3,4,5,6,7,8,9,10").ids).toHaveLength(8);
  });

  it("asks for what is drawn, within what the server gives", () => {
    const asked = new URLSearchParams(askedOf(ALL, 12));
    expect(Object.fromEntries(asked)).toEqual({
      ids: "7,3,9",
      channels: "displacement_m",
      align: "block",
      points: "200",
      block: "2",
      tolerance_abs: "25.5",
      tolerance_rel: "0.02",
      from_s: "-0.5",
      to_s: "1.25025",
    });
    expect(new URLSearchParams(askedOf({ ...ALL, align: "phase" }, 1e9)).has("from_s")).toBe(false);
    expect(new URLSearchParams(askedOf({ ...ALL, block: null }, 1e9)).get("block")).toBe("0");
  });
});

describe("the runs", () => {
  it("change the baseline, keeping the others in order", () => {
    expect(withBaseline(ALL, 9).ids).toEqual([9, 7, 3]);
  });

  it("leave, but for the last two", () => {
    const two = without(ALL, 3);
    expect([two.ids, two.hidden]).toEqual([[7, 9], []]);
    expect(without(two, 7)).toBe(two);
  });

  it("are hidden and shown", () => {
    expect(toggled(ALL, 9).hidden).toEqual([3, 9]);
    expect(toggled(ALL, 3).hidden).toEqual([]);
  });
});
