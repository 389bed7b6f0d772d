import { describe, expect, it } from "vitest";
import type { RunSamples } from "../live/types";
import { around, boxes } from "./xy";

const SAMPLES = {
  from_s: 0,
  to_s: 4,
  decimated: true,
  time_s: [0, 1, 2, 3],
  channels: {
    displacement_m: { min: [0, 1, null, 3], max: [1, 2, null, 4] },
    force_n: { min: [-5, -4, -3, -2], max: [5, 6, 7, 8] },
  },
} as RunSamples;

describe("force over displacement", () => {
  it("is a box of both extremes a column, within the window, without gaps", () => {
    expect(boxes(SAMPLES, "displacement_m", "force_n", { from_s: 0, to_s: 2.5 })).toEqual([
      { x: [0, 1], y: [-5, 5] },
      { x: [1, 2], y: [-4, 6] },
    ]);
    expect(boxes(SAMPLES, "not_there", "force_n", { from_s: 0, to_s: 4 })).toEqual([]);
  });

  it("fits around all of them", () => {
    const all = boxes(SAMPLES, "displacement_m", "force_n", { from_s: 0, to_s: 4 });
    expect(around(all)).toEqual({ x: [0, 4], y: [-5, 8] });
    expect(around([])).toBeNull();
  });
});
