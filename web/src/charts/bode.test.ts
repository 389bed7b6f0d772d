import { describe, expect, it } from "vitest";
import {
  allStoodStill,
  extremeText,
  frequencies,
  frequencyRange,
  frequencyText,
  gainText,
  nearest,
  panelOf,
  phaseText,
  spanOf,
  unwrapped,
  type BodeData,
  type BodePoint,
} from "./bode";

const point = (frequency_hz: number, gain: number, phase_deg = 0, more: Partial<BodePoint> = {}): BodePoint => ({
  ...{ frequency_hz, gain, phase_deg },
  ...more,
});
const data = (points: readonly BodePoint[], more: Partial<BodeData> = {}): BodeData => ({
  series: [{ label: "2 kN", points }],
  models: [],
  bands: [],
  unit: "1",
  decibels: true,
  ...more,
});

describe("unwrapped phase", () => {
  it("goes on where a lag passes half a turn", () => {
    expect(unwrapped([-150, -175, 170, 120])).toEqual([-150, -175, -190, -240]);
  });
  it("is what a dead time really gives", () => {
    const lag = Array.from({ length: 60 }, (_, i) => -7.2 * i);
    const wrapped = lag.map((deg) => deg - 360 * Math.round(deg / 360));
    unwrapped(wrapped).forEach((deg, i) => expect(deg).toBeCloseTo(lag[i]!, 9));
  });
  it("puts either sign of half a turn on the same side", () => {
    expect(unwrapped([179])).toEqual([-181]);
    expect(unwrapped([-179])).toEqual([-179]);
    expect(unwrapped([90])).toEqual([90]);
  });
});

describe("a panel", () => {
  it("has its points in order of frequency, however they came", () => {
    const { series } = panelOf("gain", data([point(10, 1), point(1, 10), point(5, 0.1)]));
    expect(series[0]!.map(({ hz, y }) => [hz, Math.round(y)])).toEqual([
      [1, 20],
      [5, -20],
      [10, 0],
    ]);
  });
  it("takes the interval of a phase along when that is unwrapped", () => {
    const lagging = point(2, 1, 175, { phase_low_deg: 170, phase_high_deg: 180 });
    const { series } = panelOf("phase", data([point(1, 1, -170), lagging]));
    expect(series[0]![1]).toMatchObject({ y: -185, low: -190, high: -180 });
  });
  it("leaves a gain of nothing out: it has no place on a logarithmic axis", () => {
    expect(panelOf("gain", data([point(1, 0), point(2, 1)])).series[0]).toHaveLength(1);
  });
  it("shows a gain with a unit on the logarithm of what a person reads", () => {
    const { series } = panelOf("gain", data([point(1, 20_000)], { unit: "N", decibels: false }));
    expect(series[0]![0]!.y).toBeCloseTo(Math.log10(20), 12);
  });
  it("shows what is asked for, open where only one side is", () => {
    const band = { from_hz: 1, to_hz: 50, low_db: -3, high_db: null, low_deg: null, high_deg: null };
    const { bands } = panelOf("gain", data([point(1, 1)], { bands: [band] }));
    expect(bands[0]!.low).toBeCloseTo(-3, 9);
    expect(bands[0]!.high).toBe(Infinity);
    expect(panelOf("phase", data([point(1, 1)], { bands: [band] })).bands).toEqual([]);
  });
  it("draws no point whose output stood still: its phase is chance", () => {
    const some = data([point(1, 0, 170), point(2, 1, -20)]);
    expect((["gain", "phase", "coherence"] as const).map((name) => panelOf(name, some).series[0]!.length)).toEqual([1, 1, 0]);
    expect([allStoodStill(some.series), allStoodStill(data([point(1, 0)]).series), allStoodStill([])]).toEqual([false, true, false]);
  });
  it("has no coherence where none was measured", () => {
    const { series, range } = panelOf("coherence", data([point(1, 1), point(2, 1, 0, { coherence: 0.97 })]));
    expect(series[0]).toHaveLength(1);
    expect(range.min).toBeCloseTo(0.9425, 9);
    expect(range.max).toBeCloseTo(1.0175, 9);
  });
});

describe("ranges", () => {
  it("hold everything, with a margin and a least width", () => {
    const { min, max } = spanOf([-3, 5], 2);
    expect(min).toBeLessThan(-3);
    expect(max).toBeGreaterThan(5);
    expect(spanOf([1], 2)).toEqual({ min: 0, max: 2 });
    expect(spanOf([], 2)).toEqual({ min: -1, max: 1 });
  });
  it("cover what is still to come, by the model", () => {
    const model = { frequencies_hz: [1, 100], gain: [1, 1], phase_deg: [0, 0] };
    const { min, max } = frequencyRange(data([point(2, 1)], { models: [model] }));
    expect(min).toBeLessThan(1);
    expect(max).toBeGreaterThan(100);
  });
  it("are something before there is anything", () => {
    expect(frequencyRange(data([]))).toEqual({ min: 1, max: 100 });
  });
});

describe("the cursor", () => {
  const series = [
    { label: "a", points: [point(10, 1), point(1, 1)] },
    { label: "b", points: [point(10, 1), point(100, 1)] },
  ];
  it("can be at any frequency that has a point, once", () => {
    expect(frequencies(series)).toEqual([1, 10, 100]);
  });
  it("takes the nearest as the eye sees it", () => {
    expect(nearest([1, 10], 3)).toBe(1);
    expect(nearest([1, 10], 4)).toBe(10);
    expect(nearest([], 4)).toBeNull();
  });
});

describe("words", () => {
  it("call extremes out as the paper does", () => {
    expect(extremeText({ frequency_hz: 35, gain_db: 3.6 })).toBe("+3.6\u00a0dB at 35\u00a0Hz");
    expect(extremeText({ frequency_hz: 85, gain_db: -2 })).toBe("\u22122.0\u00a0dB at 85\u00a0Hz");
  });
  it("read frequencies and figures with as many digits as they carry", () => {
    expect(frequencyText(2.5)).toBe("2.5\u00a0Hz");
    expect(frequencyText(99.96)).toBe("100\u00a0Hz");
    expect(gainText({ unit: "N", decibels: false }, 20_512.6)).toBe("20.51\u00a0kN");
    expect(gainText({ unit: "1", decibels: true }, 1)).toBe("0.00\u00a0dB");
    expect(phaseText(-87.44)).toBe("\u221287.4°");
    expect(phaseText(12)).toBe("12.0°");
  });
});
