import { describe, expect, it } from "vitest";
import { extentOf, marksIn, peakOf } from "./previewBands";

const band = { time_s: [0, 1, 2, 3], min: [0, -5, -2, -7], max: [1, 4, 7, 3] };

describe("preview", () => {
  it("marks the first of what is farthest from zero", () => {
    expect(peakOf(band)).toEqual({ time_s: 2, value: 7 });
    expect(peakOf({ ...band, min: [0, -9, -9, 0] })).toEqual({ time_s: 1, value: -9 });
    expect(peakOf({ time_s: [0], min: [0], max: [0] })).toBeNull();
    expect(peakOf({ time_s: [], min: [], max: [] })).toBeNull();
  });

  it("knows how far a band goes", () => {
    expect(extentOf(band)).toEqual({ low: -7, high: 7 });
    expect(extentOf({ time_s: [], min: [], max: [] }).low).toBeNaN();
  });

  it("shows the blocks that are in view", () => {
    const blocks = [0, 1, 2].map((index) => ({ index, start_s: index, duration_s: 1, kind: "hold", cycles: 0 }));
    expect(marksIn(blocks, { from_s: 1, to_s: 1.5 }).map((mark) => mark.number)).toEqual([2]);
    expect(marksIn(blocks, { from_s: 0, to_s: 3 })).toHaveLength(3);
  });
});
