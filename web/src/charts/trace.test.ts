import { describe, expect, it } from "vitest";
import { SampleRing } from "../live/ring";
import { Trace } from "./trace";

const PERIOD_S = 1 / 4000;

function ringOf(samples: number, value: (tick: number) => number): SampleRing {
  const ring = new SampleRing(["force_n", "force_command_n"], 240_000);
  const one = Float32Array.from({ length: samples }, (_, i) => value(i));
  ring.push(0, [one, one.map((force) => -2 * force)]);
  return ring;
}
const ascending = (x: readonly number[]): boolean => x.every((value, i) => i === 0 || value > x[i - 1]!);

describe("Trace", () => {
  it("draws every sample where they fit, the newest at zero seconds", () => {
    const trace = new Trace(["force_n", "force_command_n"]);
    trace.update(
      ringOf(8000, (tick) => tick),
      0.2,
      PERIOD_S,
      900,
      [true, true],
    );
    expect(trace.x).toHaveLength(800);
    expect(trace.x.at(-1)).toBe(0);
    expect(trace.x[0]).toBeCloseTo(-799 * PERIOD_S, 12);
    expect(trace.ys[0]!.at(-1)).toBe(7999);
    expect(ascending(trace.x)).toBe(true);
  });

  it("draws two points a column where there are more samples than pixels, and keeps a lone peak", () => {
    const trace = new Trace(["force_n"]);
    const ring = ringOf(240_000, (tick) => (tick === 123_457 ? 1e4 : 0));
    trace.update(ring, 60, PERIOD_S, 900, [true]);
    expect(trace.x.length).toBeLessThanOrEqual(1802);
    expect(ascending(trace.x)).toBe(true);
    const peak = trace.ys[0]!.indexOf(1e4);
    expect(trace.x[peak]!).toBeCloseTo((123_457 - 239_999) * PERIOD_S, 1);
    expect(trace).toMatchObject({ low: 0, high: 1e4 });
  });

  it("leaves hidden series out of the range", () => {
    const trace = new Trace(["force_n", "force_command_n"]);
    trace.update(
      ringOf(1000, () => 10),
      1,
      PERIOD_S,
      900,
      [true, false],
    );
    expect(trace).toMatchObject({ low: 10, high: 10 });
  });

  it("shows lost ticks as nothing at either zoom", () => {
    const ring = ringOf(1000, () => 1);
    ring.push(3000, [new Float32Array(1000).fill(1), new Float32Array(1000).fill(1)]);
    const trace = new Trace(["force_n"]);
    trace.update(ring, 1, PERIOD_S, 4000, [true]);
    expect(trace.ys[0]!.filter((value) => value === null)).toHaveLength(2000);
    trace.update(ring, 1, PERIOD_S, 100, [true]);
    expect(trace.ys[0]!.filter((value) => value === null)).toHaveLength(100);
  });

  it("gives the same picture whether it kept up or looks for the first time", () => {
    const ring = new SampleRing(["force_n"], 240_000);
    const keptUp = new Trace(["force_n"]);
    for (let tick = 0; tick < 40_000; tick += 133) {
      ring.push(tick, [Float32Array.from({ length: 133 }, (_, i) => Math.sin((tick + i) / 50))]);
      keptUp.update(ring, 5, PERIOD_S, 700, [true]);
    }
    const first = new Trace(["force_n"]);
    first.update(ring, 5, PERIOD_S, 700, [true]);
    // the oldest column alone may differ: whoever kept up still knows samples that have left the window
    expect(keptUp.ys[0]!.slice(2)).toEqual(first.ys[0]!.slice(2));
    expect(keptUp.x).toEqual(first.x);
  });

  it("survives a channel that is not offered and a ring without samples", () => {
    const trace = new Trace(["not_there"]);
    trace.update(new SampleRing(["force_n"], 100), 1, PERIOD_S, 900, [true]);
    expect(trace.x).toEqual([]);
    trace.update(
      ringOf(10, () => 1),
      0.2,
      PERIOD_S,
      900,
      [true],
    );
    expect(trace.ys[0]).toEqual(Array(10).fill(null));
    expect(trace.low).toBeNaN();
  });
});
