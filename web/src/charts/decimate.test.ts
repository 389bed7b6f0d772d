import { describe, expect, it } from "vitest";
import { bucketTicks, decimate } from "./decimate";
import { Envelope } from "./envelope";
import { SampleRing } from "../live/ring";

function randoms(seed: number): (below: number) => number {
  let state = seed;
  return (below) => (state = (state * 1103515245 + 12345) % 2147483648) % below;
}

describe("decimate", () => {
  it("keeps the extremes of each column in the order in which they happened", () => {
    const values = Float32Array.from([1, 5, 2, 9, 3, -4, 7, 7]);
    expect([...decimate(values, 0, 8, 4)]).toEqual([1, 9, -4, 7]);
    expect([...decimate(values, 2, 6, 3)]).toEqual([2, 2, 9, -4]);
  });

  it("keeps a peak of a single tick, wherever it is", () => {
    for (let at = 0; at < 4000; at += 37) {
      const values = new Float32Array(4000);
      values[at] = 1e4;
      expect(Math.max(...decimate(values, 0, 4000, 133))).toBe(1e4);
    }
  });

  it("leaves lost ticks out and shows a column without any as nothing", () => {
    const values = Float32Array.from([NaN, 2, NaN, NaN, NaN, NaN]);
    expect([...decimate(values, 0, 6, 2)]).toEqual([2, 2, NaN, NaN, NaN, NaN]);
  });

  it("draws every sample when each column is one tick", () => {
    expect([...decimate(Float32Array.from([3, 1, 2]), 0, 3, 1)]).toEqual([3, 3, 1, 1, 2, 2]);
  });

  it("gives nothing for an empty span", () => {
    expect(decimate(new Float32Array(4), 3, 3, 2)).toHaveLength(0);
  });

  it("agrees with a plain search over random spans, ring positions and gaps", () => {
    const random = randoms(11);
    for (let round = 0; round < 300; round += 1) {
      const size = 1 + random(200);
      const values = Float32Array.from({ length: size }, () => (random(5) === 0 ? NaN : random(2001) - 1000));
      const from = random(10000);
      const to = from + 1 + random(size);
      const bucket = 1 + random(30);
      const result = decimate(values, from, to, bucket);
      let i = 0;
      for (let start = from - (from % bucket); start < to; start += bucket, i += 2) {
        const inside: number[] = [];
        for (let tick = Math.max(from, start); tick < Math.min(to, start + bucket); tick += 1) {
          if (!Number.isNaN(values[tick % size])) inside.push(values[tick % size]!);
        }
        const [a, b] = [result[i]!, result[i + 1]!];
        if (inside.length === 0) {
          expect([a, b]).toEqual([NaN, NaN]);
          continue;
        }
        expect(Math.min(a, b)).toBe(Math.min(...inside));
        expect(Math.max(a, b)).toBe(Math.max(...inside));
        expect(inside.indexOf(a)).toBeLessThanOrEqual(inside.indexOf(b));
      }
      expect(result.length).toBe(i);
    }
  });
});

describe("bucketTicks", () => {
  it("draws every sample up to two a pixel, then one column a pixel", () => {
    expect(bucketTicks(800, 900)).toBe(1);
    expect(bucketTicks(1800, 900)).toBe(1);
    expect(bucketTicks(4000, 900)).toBe(5);
    expect(bucketTicks(240000, 900)).toBe(267);
    expect(bucketTicks(240000, 0)).toBe(1);
  });
});

describe("Envelope", () => {
  it("agrees, step by step, with decimating the whole window again", () => {
    const random = randoms(3);
    const ring = new SampleRing(["force_n"], 500);
    const envelope = new Envelope("force_n", 7, 100);
    let tick = 12345;
    for (let step = 0; step < 400; step += 1) {
      if (random(15) === 0) tick += random(40);
      if (random(100) === 0) tick = random(50);
      const samples = 1 + random(60);
      ring.push(tick, [Float32Array.from({ length: samples }, () => random(1000))]);
      tick += samples;
      envelope.update(ring);

      const from = Math.max(Math.ceil(ring.firstTick / 7), Math.ceil(ring.endTick / 7) - 100);
      const expected = decimate(ring.columns[0]!, Math.max(ring.firstTick, from * 7), ring.endTick, 7);
      const columns = Math.max(0, Math.ceil(ring.endTick / 7) - from);
      for (let i = 0; i < columns; i += 1) {
        expect([envelope.firstOf(from + i), envelope.secondOf(from + i)]).toEqual([
          expected[2 * i],
          expected[2 * i + 1],
        ]);
      }
    }
  });
});
