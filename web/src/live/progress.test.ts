import { describe, expect, it } from "vitest";
import { segments, shareDone, timeLeft_s } from "./progress";

const BLOCKS = [
  { index: 0, kind: "hold", start_s: 0, duration_s: 1 },
  { index: 1, kind: "harmonic", start_s: 1, duration_s: 6 },
  { index: 2, kind: "hold", start_s: 7, duration_s: 1 },
];
const at = (elapsed_s: number, block: number, duration_s: number | null = 8): Parameters<typeof segments>[1] => ({
  elapsed_s,
  duration_s,
  block,
});

describe("progress", () => {
  it("is a share of the whole, and the time that is left", () => {
    expect(shareDone(at(2, 1))).toBe(0.25);
    expect(shareDone(at(9, 2))).toBe(1);
    expect(shareDone(at(2, 1, null))).toBeNull();
    expect(timeLeft_s(at(2, 1))).toBe(6);
    expect(timeLeft_s(at(9, 2))).toBe(0);
    expect(timeLeft_s(at(9, 2, null))).toBeNull();
  });

  it("draws blocks to scale, past, present and to come", () => {
    const drawn = segments(BLOCKS, at(2, 1));
    expect(drawn.map(({ from, width }) => [from, width])).toEqual([
      [0, 0.125],
      [0.125, 0.75],
      [0.875, 0.125],
    ]);
    expect(drawn.map(({ state }) => state)).toEqual(["past", "present", "to come"]);
  });

  it("knows what is past between blocks, too", () => {
    expect(segments(BLOCKS, at(7.5, -1)).map(({ state }) => state)).toEqual(["past", "past", "to come"]);
  });

  it("draws none where there is no end, or too many to be seen", () => {
    expect(segments(BLOCKS, at(1, 0, null))).toEqual([]);
    expect(segments(Array(1000).fill(BLOCKS[0]), at(1, 0))).toEqual([]);
  });
});
