import { describe, expect, it } from "vitest";
import { aDetector } from "./aDetector";
import { barOf, nearnessOf } from "./margin";

describe("barOf", () => {
  it("has both limits of a magnitude, and rests in the middle", () => {
    const bar = barOf(aDetector({ threshold: 50 }), 25)!;
    expect(bar.bar[0]).toBeCloseTo(0.5);
    expect(bar.limits[0]! + bar.limits[1]!).toBeCloseTo(1);
    expect((bar.bar[1] - 0.5) / (bar.limits[1]! - 0.5)).toBeCloseTo(0.5);
  });

  it("passes the limit exactly where the value does", () => {
    for (const comparison of ["magnitude_above", "above", "outside"] as const) {
      const detector = aDetector({ comparison, threshold: 50, low: -50 });
      const end = (value: number): number => barOf(detector, value)!.bar[1];
      const limit = barOf(detector, 0)!.limits.at(-1)!;
      expect(end(49)).toBeLessThan(limit);
      expect(end(51)).toBeGreaterThan(limit);
    }
    const below = aDetector({ comparison: "below", threshold: 150 });
    expect(barOf(below, 151)!.bar[1]).toBeGreaterThan(barOf(below, 151)!.limits[0]!);
    expect(barOf(below, 149)!.bar[1]).toBeLessThan(barOf(below, 149)!.limits[0]!);
  });

  it("stays within its ends, whatever the value", () => {
    for (const comparison of ["magnitude_above", "above", "below", "outside"] as const)
      for (const threshold of [-5, 0, 5])
        for (const value of [-1e9, -1, 0, 1, 1e9]) {
          const { bar, limits, beyond } = barOf(aDetector({ comparison, threshold, low: threshold - 2 }), value)!;
          for (const share of [...bar, ...limits, ...beyond.flat()]) {
            expect(share).toBeGreaterThanOrEqual(0);
            expect(share).toBeLessThanOrEqual(1);
          }
        }
  });

  it("is none where there is no figure", () => {
    expect(barOf(aDetector(), null)).toBeNull();
    expect(barOf(aDetector(), NaN)).toBeNull();
  });
});

it("a margin is small before it is gone", () => {
  expect([0.5, 0.05, 0, -0.1, null].map(nearnessOf)).toEqual(["within", "near", "near", "beyond", "within"]);
});
