import { describe, expect, it } from "vitest";
import { logTicks } from "./logTicks";

const labels = (min: number, max: number, room: number): number[] => [...logTicks(min, max, room).labelled];

describe("marks of a logarithmic axis", () => {
  it("are 1, 2, 5, 10 … with the others between as grid", () => {
    expect(labels(1, 100, 10)).toEqual([1, 2, 5, 10, 20, 50, 100]);
    expect(logTicks(1, 10, 5).at).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
  });
  it("are fewer where there is little room, and more where there is much", () => {
    expect(labels(0.1, 1000, 6)).toEqual([0.1, 1, 10, 100, 1000]);
    expect(labels(1, 10, 40)).toHaveLength(10);
  });
  it("are even within a part of a decade", () => {
    expect(labels(10.2, 10.9, 8)).toEqual([10.2, 10.4, 10.6, 10.8]);
  });
  it.each([
    [1e-3, 3e3],
    [0.97, 103],
    [33, 37],
    [1, 1.0001],
    [2e-9, 5e-7],
  ])("lie within %d…%d, upwards, and have at least one label", (min, max) => {
    for (const room of [1, 4, 12, 60]) {
      const { at, labelled } = logTicks(min, max, room);
      expect([...at].sort((a, b) => a - b)).toEqual(at);
      expect(at.every((mark) => mark >= min * (1 - 1e-9) && mark <= max * (1 + 1e-9))).toBe(true);
      expect(labelled.size).toBeGreaterThan(0);
    }
  });
});
