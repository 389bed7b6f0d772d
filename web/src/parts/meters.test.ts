import { describe, expect, it } from "vitest";
import { meterShape, nearness } from "./meters";

const FORCE = { low: -50e3, high: 50e3 };

describe("meterShape", () => {
  it("grows from zero to the value", () => {
    expect(meterShape(25e3, undefined, null, FORCE)).toEqual({
      zero: 0.5,
      bar: [0.5, 0.75],
      band: null,
      commanded: null,
    });
    expect(meterShape(-25e3, undefined, -50e3, FORCE)).toMatchObject({ bar: [0.25, 0.5], commanded: 0 });
    expect(meterShape(21e6, undefined, undefined, { low: 0, high: 28e6 }).bar).toEqual([0, 0.75]);
  });

  it("stays on the scale and draws nothing for what is not known", () => {
    expect(meterShape(9e9, { low: -9e9, high: 0 }, NaN, FORCE)).toMatchObject({
      bar: [0.5, 1],
      band: [0, 0.5],
      commanded: null,
    });
    expect(meterShape(NaN, { low: NaN, high: NaN }, null, FORCE)).toMatchObject({
      bar: [0.5, 0.5],
      band: null,
    });
  });
});

describe("nearness", () => {
  it("judges the extremes of the last second, not only the value of now", () => {
    expect(nearness(0, { low: -46e3, high: 2e3 }, 50e3)).toBe("near");
    expect(nearness(0, { low: -1, high: 50e3 }, 50e3)).toBe("beyond");
    expect(nearness(44e3, { low: 0, high: 44e3 }, 50e3)).toBe("within");
  });

  it("is never near where there is no limit", () => {
    expect(nearness(1e9, undefined, null)).toBe("within");
    expect(nearness(NaN, undefined, 5)).toBe("within");
  });
});
