import { describe, expect, it } from "vitest";
import { SampleRing } from "./ring";

const ramp = (from: number, samples: number): Float32Array =>
  Float32Array.from({ length: samples }, (_, i) => from + i);

/** What the ring holds, oldest first. */
function held(ring: SampleRing, channel = "force_n"): number[] {
  const column = ring.column(channel)!;
  return Array.from(
    { length: ring.endTick - ring.firstTick },
    (_, i) => column[(ring.firstTick + i) % ring.capacity]!,
  );
}

/** A ring of one channel whose value is its own tick, so that misplaced samples show. */
function filled(capacity: number, ...blocks: [firstTick: number, samples: number][]): SampleRing {
  const ring = new SampleRing(["force_n"], capacity);
  for (const [firstTick, samples] of blocks) ring.push(firstTick, [ramp(firstTick, samples)]);
  return ring;
}

describe("SampleRing", () => {
  it("keeps the newest samples, each at its tick", () => {
    const ring = filled(8, [1000, 5], [1005, 5]);
    expect(held(ring)).toEqual([1002, 1003, 1004, 1005, 1006, 1007, 1008, 1009]);
    expect(ring).toMatchObject({ firstTick: 1002, endTick: 1010, received: 10 });
  });

  it("keeps channels apart", () => {
    const ring = new SampleRing(["force_n", "valve_command"], 4);
    ring.push(0, [ramp(0, 2), ramp(50, 2)]);
    expect(held(ring, "valve_command")).toEqual([50, 51]);
    expect(ring.column("not_there")).toBeUndefined();
  });

  it("leaves a gap of NaN where ticks were lost, and counts it", () => {
    const ring = filled(10, [100, 3], [105, 2]);
    expect(held(ring)).toEqual([100, 101, 102, NaN, NaN, 105, 106]);
    expect(ring.gaps).toEqual([{ fromTick: 103, toTick: 105 }]);
    expect(ring.missingTicks()).toBe(2);
    expect(ring.missingTicks(104)).toBe(1);
  });

  it("overwrites what an older lap left in a gap", () => {
    const ring = filled(6, [0, 6], [6, 1], [10, 1]);
    expect(held(ring)).toEqual([5, 6, NaN, NaN, NaN, 10]);
  });

  it("forgets gaps that have left the window", () => {
    const ring = filled(6, [0, 2], [4, 6]);
    expect(ring.gaps).toEqual([]);
    expect(held(ring)).toEqual([4, 5, 6, 7, 8, 9]);
  });

  it("starts anew when the loop was restarted and counts from the beginning", () => {
    const ring = filled(8, [5000, 6]);
    const before = ring.generation;
    ring.push(0, [ramp(0, 2)]);
    expect(held(ring)).toEqual([0, 1]);
    expect(ring.generation).toBe(before + 1);
    expect(ring.missingTicks()).toBe(0);
  });

  it("starts anew after a gap longer than the window", () => {
    expect(held(filled(4, [0, 4], [100, 2]))).toEqual([100, 101]);
  });

  it("takes a block longer than itself", () => {
    expect(held(filled(4, [0, 11]))).toEqual([7, 8, 9, 10]);
  });

  it("ignores an empty block and one of another subscription", () => {
    const ring = filled(4, [0, 2]);
    ring.push(2, [new Float32Array(0)]);
    ring.push(2, [ramp(0, 2), ramp(0, 2)]);
    expect(held(ring)).toEqual([0, 1]);
  });

  it("freezes into a copy that stands still", () => {
    const ring = filled(8, [0, 3]);
    const frozen = ring.freeze();
    ring.push(3, [ramp(3, 8)]);
    expect(held(frozen)).toEqual([0, 1, 2]);
  });

  it("agrees with a plain list over random blocks, gaps and restarts", () => {
    let seed = 7;
    const random = (below: number): number => (seed = (seed * 1103515245 + 12345) % 2147483648) % below;
    const ring = new SampleRing(["force_n"], 64);
    let expected = new Map<number, number>();
    let end = 0;
    for (let step = 0; step < 500; step += 1) {
      const jump = random(10) === 0 ? random(90) : 0;
      const restart = random(60) === 0;
      const first = restart ? 0 : end + jump;
      if (restart || jump >= 64) expected = new Map();
      const samples = 1 + random(40);
      const block = Float32Array.from({ length: samples }, () => random(1000));
      block.forEach((value, i) => expected.set(first + i, value));
      ring.push(first, [block]);
      end = first + samples;
      const from = ring.firstTick;
      expect(held(ring)).toEqual(Array.from({ length: end - from }, (_, i) => expected.get(from + i) ?? NaN));
      expect(end - from).toBeLessThanOrEqual(64);
    }
  });
});
