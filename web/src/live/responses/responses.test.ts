import { describe, expect, it } from "vitest";
import { bodeModels, bodeSeries, counted, seriesLabel } from "./bode";
import { merged } from "./merging";
import type { FrequencyResponse, ResponseFrame, ResponsePoint, ResponseSeries } from "./types";

const point = (frequency_hz: number, more: Partial<ResponsePoint> = {}): ResponsePoint => ({
  ...{ frequency_hz, amplitude_n: 2000, asked_n: more.amplitude_n ?? 2000, amplitude_m: null, mean_n: 0, gain: 1, gain_db: 0, phase_deg: 0, gain_low: 0.9, gain_high: 1.1 },
  ...{ phase_low_deg: -1, phase_high_deg: 1, coherence: 0.99, distortion_percent: null, noise_std: null },
  ...{ nonlinear_std: null, cycles: 10, settled: true },
  ...more,
});
const NONE = { peak: null, dip: null, minus_3_db_hz: null, minus_90_deg_hz: null };
const series = (amplitude_n: number, more: Partial<ResponseSeries> = {}): ResponseSeries => ({
  ...{ block: 0, method: "stepped_sine", amplitude_n, amplitude_m: null, mean_n: 0, points: [], extremes: NONE },
  ...more,
});
const response = (all: ResponseSeries[]): FrequencyResponse => ({
  ...{ transfer: "force", unit: "1", available: ["force"], series: all, model: [], bands: [], margins: [], progress: null },
});
const frame = (of: ResponsePoint, more: Partial<ResponseFrame> = {}): ResponseFrame => ({
  ...{ type: "response", run: 1, block: 0, transfer: "force", point: of },
  ...more,
});

describe("a live point", () => {
  it("takes its place among the others, in order of frequency", () => {
    const before = response([series(2000, { points: [point(1), point(10)] })]);
    const { series: after } = merged(before, frame(point(5)));
    expect(after[0]!.points.map(({ frequency_hz }) => frequency_hz)).toEqual([1, 5, 10]);
    expect(before.series[0]!.points).toHaveLength(2);
  });
  it("replaces the one that it is newer than", () => {
    const before = response([series(2000, { points: [point(5, { settled: false, gain: 2 })] })]);
    const after = merged(before, frame(point(5, { gain: 1.2 })));
    expect(after.series[0]!.points).toEqual([point(5, { gain: 1.2 })]);
    expect(counted(after)).toEqual({ points: 1, moving: 0 });
  });
  it("that was backed off belongs to the amplitude that was asked for", () => {
    const before = response([series(4000), series(8000)]);
    const after = merged(before, frame(point(50, { amplitude_n: 4000, asked_n: 8000 })));
    expect(after.series.map(({ points }) => points.length)).toEqual([0, 1]);
  });
  it("of another amplitude, mean or block begins a series", () => {
    const before = response([series(2000)]);
    expect(merged(before, frame(point(5, { amplitude_n: 3000 }))).series).toHaveLength(2);
    expect(merged(before, frame(point(5, { mean_n: 500 }))).series).toHaveLength(2);
    expect(merged(before, frame(point(5), { block: 3 })).series).toHaveLength(2);
  });
  it("of another transfer changes nothing", () => {
    const before = response([series(2000)]);
    expect(merged(before, frame(point(5), { transfer: "plant" }))).toBe(before);
  });
});

describe("series", () => {
  it("are told apart by what differs", () => {
    const two = [series(1000), series(2500)];
    expect(two.map((one) => seriesLabel(one, two))).toEqual(["1\u00a0kN", "2.5\u00a0kN"]);
    const means = [series(1000), series(1000, { mean_n: 10_000 })];
    expect(seriesLabel(means[1]!, means)).toBe("1\u00a0kN about 10\u00a0kN");
    const methods = [series(1000), series(1000, { method: "multisine", block: 1 })];
    expect(seriesLabel(methods[1]!, methods)).toBe("1\u00a0kN multisine");
    const blocks = [series(1000), series(1000, { block: 4 })];
    expect(seriesLabel(blocks[1]!, blocks)).toBe("1\u00a0kN block 5");
    const moved = [0, 10_000].map((mean_n) => series(0, { amplitude_m: 0.001, mean_n, method: "multisine" }));
    expect(seriesLabel(moved[1]!, moved)).toBe("1\u00a0mm under 10\u00a0kN");
  });
  it("carry peak and dip to the chart, and the model its series", () => {
    const peak = { frequency_hz: 35, gain_db: 3.6 };
    const found = response([series(1000), series(2000, { extremes: { ...NONE, peak } })]);
    const curve = { frequencies_hz: [1], gain: [1], phase_deg: [0] };
    found.model = [{ amplitude_n: 2000, mean_n: 0, ...curve }];
    expect(bodeSeries(found)[1]!.extremes).toEqual([peak]);
    expect(bodeModels(found)).toEqual([{ ...curve, of: 1 }]);
  });
  it("is marked where the margins of an open loop are read off", () => {
    const of = { block: 0, method: "stepped_sine" as const, amplitude_n: 2000, mean_n: 0, worst_sensitivity: 1.5 };
    const margins = [{ ...of, crossover_hz: 48, phase_margin_deg: 57, gain_margin_db: 10, turnover_hz: 200 }];
    const [loop] = bodeSeries({ ...response([series(2000)]), transfer: "loop", margins });
    expect(loop!.extremes!.map(({ frequency_hz, gain_db }) => [frequency_hz, gain_db])).toEqual([
      [48, 0],
      [200, -10],
    ]);
  });
});
