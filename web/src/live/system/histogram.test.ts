import { describe, expect, it } from "vitest";
import { bars, quantile_s, since } from "./histogram";
import type { Histogram } from "./types";

const BIN_S = 1e-6;
const histogram = (filled: Record<number, number>, bins = 1000): Histogram => {
  const counts = Array.from({ length: bins }, (_, i) => filled[i] ?? 0);
  return { bin_s: BIN_S, counts, p50_s: null, p99_s: null, p999_s: null, longest_s: null };
};

describe("bars", () => {
  it("shows no less than 50 µs, so that a quick loop looks quick", () => {
    const { edges_s, counts } = bars(histogram({ 3: 10 }), 200);
    expect(counts).toHaveLength(50);
    expect(counts[3]).toBe(10);
    expect(edges_s.at(-1)).toBeCloseTo(50e-6, 12);
  });

  it("keeps every count where bins are put together", () => {
    const { counts, edges_s } = bars(histogram({ 0: 5, 401: 2, 899: 1 }), 100);
    expect(counts.length).toBeLessThanOrEqual(100);
    expect(counts.reduce((a, b) => a + b)).toBe(8);
    expect(edges_s).toHaveLength(counts.length + 1);
  });

  it("counts apart what was longer than it reaches", () => {
    const { counts, beyond } = bars(histogram({ 998: 1, 999: 7 }), 100);
    expect(beyond).toBe(7);
    expect(counts.reduce((a, b) => a + b)).toBe(1);
  });
});

describe("quantile_s", () => {
  it("interpolates within its bin", () => {
    const { counts } = histogram({ 10: 50, 20: 50 });
    expect(quantile_s(counts, BIN_S, 0.25)).toBeCloseTo(10.5e-6, 12);
    expect(quantile_s(counts, BIN_S, 0.5)).toBeCloseTo(11e-6, 12);
    expect(quantile_s(counts, BIN_S, 1)).toBeCloseTo(21e-6, 12);
  });

  it("is unknown without counts and beyond the last bin", () => {
    expect(quantile_s(histogram({}).counts, BIN_S, 0.5)).toBeNull();
    expect(quantile_s(histogram({ 10: 1, 999: 9 }).counts, BIN_S, 0.99)).toBeNull();
  });
});

describe("since", () => {
  it("is what was added, with figures of its own", () => {
    const { counts, longest_s } = since(histogram({ 5: 10, 700: 1 }), histogram({ 5: 4, 700: 1 }));
    expect(counts[5]).toBe(6);
    expect(longest_s).toBeCloseTo(6e-6, 12);
  });
});
