import { describe, expect, it } from "vitest";
import { roundUp, steadyRange, type SteadyRange } from "./scale";

const FORCE = { centred: true, minSpan: 200 };
const POSITION = { centred: false, minSpan: 1e-4 };

describe("steadyRange", () => {
  it("centres force on zero and rounds", () => {
    expect(steadyRange(null, -500, 2010, 0, FORCE)).toMatchObject({ min: -2500, max: 2500 });
  });

  it("follows displacement wherever it is", () => {
    const range = steadyRange(null, 0.0101, 0.0109, 0, POSITION);
    expect(range.min).toBeLessThan(0.0101);
    expect(range.max).toBeGreaterThan(0.0109);
    expect(range.max - range.min).toBeLessThan(0.0013);
  });

  it("is never so narrow that noise fills the chart", () => {
    const range = steadyRange(null, 3, 4, 0, FORCE);
    expect(range.max - range.min).toBeGreaterThanOrEqual(200);
    expect(steadyRange(null, 0.01, 0.01, 0, POSITION).max).toBeGreaterThan(0.01);
  });

  it("does not move while a noisy sine goes on", () => {
    let range: SteadyRange | null = null;
    const seen = new Set<string>();
    for (let frame = 0; frame < 1800; frame += 1) {
      const wobble = 30 * Math.sin(frame * 1.7);
      range = steadyRange(range, -2000 - wobble, 2000 + wobble, frame / 30, FORCE);
      if (frame > 5) seen.add(`${range.min} ${range.max}`);
    }
    expect(seen.size).toBe(1);
  });

  it("grows at once, so that nothing is ever cut off", () => {
    const before = steadyRange(null, -900, 900, 0, FORCE);
    const after = steadyRange(before, -900, 7000, 0.03, FORCE);
    expect(after.max).toBeGreaterThanOrEqual(7000);
  });

  it("shrinks only after three quiet seconds", () => {
    const wide = steadyRange(null, -20000, 20000, 0, FORCE);
    let range = steadyRange(wide, -900, 900, 10, FORCE);
    expect(range.max).toBe(wide.max);
    range = steadyRange(range, -900, 900, 12.9, FORCE);
    expect(range.max).toBe(wide.max);
    range = steadyRange(range, -900, 900, 13, FORCE);
    expect(range.max).toBe(1000);
  });

  it("waits anew when a large value comes in between", () => {
    let range = steadyRange(null, -20000, 20000, 0, FORCE);
    const wide = range.max;
    range = steadyRange(range, -900, 900, 1, FORCE);
    range = steadyRange(range, -900, 19000, 3, FORCE);
    range = steadyRange(range, -900, 900, 4.5, FORCE);
    expect(range.max).toBe(wide);
  });

  it("holds the range where there are no data", () => {
    const before = steadyRange(null, -900, 900, 0, FORCE);
    expect(steadyRange(before, NaN, NaN, 1, FORCE)).toEqual(before);
    expect(steadyRange(null, NaN, NaN, 1, FORCE).max).toBeGreaterThan(0);
  });

  it("always holds the data, whatever they do", () => {
    let seed = 5;
    const random = (): number => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
    for (const options of [FORCE, POSITION]) {
      let range: SteadyRange | null = null;
      for (let frame = 0; frame < 3000; frame += 1) {
        const scale = options.minSpan * 10 ** (4 * random() - 1);
        const low = (random() - 0.5) * scale;
        const high = low + random() * scale;
        range = steadyRange(range, low, high, frame / 10, options);
        expect(range.min).toBeLessThanOrEqual(low);
        expect(range.max).toBeGreaterThanOrEqual(high);
      }
    }
  });
});

describe("roundUp", () => {
  it("finds the next round number", () => {
    expect([1, 1.01, 2.2, 9, 0.031, 1e-6].map(roundUp)).toEqual([
      1,
      1.2,
      2.5,
      10,
      expect.closeTo(0.04, 9),
      1e-6,
    ]);
  });
});
