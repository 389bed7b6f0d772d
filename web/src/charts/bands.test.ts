import { describe, expect, it } from "vitest";
import type { RunSamples } from "../live/types";
import { FORCE } from "../units";
import { bandData, bandExtent, bandFigure, place } from "./bands";

const SAMPLES: RunSamples = {
  from_s: 0,
  to_s: 3,
  decimated: true,
  time_s: [0, 1, 2],
  channels: { force_n: { min: [-10, null, 4], max: [10, null, 4] } },
};

describe("bands", () => {
  it("are a lower and an upper line for each channel, with gaps where ticks are missing", () => {
    expect(bandData(SAMPLES, ["force_n"])).toEqual([
      [0, 1, 2],
      [-10, null, 4],
      [10, null, 4],
    ]);
    expect(bandExtent(SAMPLES, ["force_n"])).toEqual({ low: -10, high: 10 });
  });

  it("stay aligned where a channel was not recorded", () => {
    expect(bandData(SAMPLES, ["not_there"])).toEqual([
      [0, 1, 2],
      [null, null, null],
      [null, null, null],
    ]);
    expect(bandExtent(SAMPLES, ["not_there"])).toEqual({ low: NaN, high: NaN });
  });

  it("read as one figure, or as both extremes", () => {
    expect(bandFigure(SAMPLES, "force_n", 0, FORCE)).toBe("−0.010 … 0.010");
    expect(bandFigure(SAMPLES, "force_n", 2, FORCE)).toBe("0.004");
    expect(bandFigure(SAMPLES, "force_n", 1, FORCE)).toBe("—");
  });

  it("are measured within the window only", () => {
    expect(bandExtent(SAMPLES, ["force_n"], { from_s: 1, to_s: 3 })).toEqual({ low: 4, high: 4 });
  });

  it("are found by time, the nearest one", () => {
    expect([-5, 0.4, 0.6, 1.9, 99].map((at_s) => place(SAMPLES, at_s))).toEqual([0, 0, 1, 2, 2]);
    expect(place({ ...SAMPLES, time_s: [] }, 0)).toBeNull();
  });
});
