import { describe, expect, it } from "vitest";
import type { RunSamples } from "../live/types";
import { arrived, composed, EMPTY, failed, looked, requestFor, type Loading, type Request } from "./loading";
import { whole, zoomTo, type ZoomStack } from "./zoom";

const PERIOD_S = 1 / 4000;
const RUN = { from_s: 0, to_s: 100 };
const at = (from_s: number, to_s: number): ZoomStack => zoomTo(whole(100), { from_s, to_s }, PERIOD_S);

/** An answer that says of each column which density it has. */
function answer({ from_s, to_s, points }: Request, decimated = true): RunSamples {
  const time_s = Array.from({ length: 10 }, (_, i) => from_s + ((to_s - from_s) * (i + 0.5)) / 10);
  const values = time_s.map(() => points);
  return { from_s, to_s, decimated, time_s, channels: { force_n: { min: values, max: values } } } as RunSamples;
}
const give = (state: Loading, decimated = true): Loading =>
  arrived(state, state.inFlight!, answer(state.inFlight!, decimated), RUN);
const opened = (): Loading => give(looked(EMPTY, whole(100), 800, "force"));

describe("loading", () => {
  it("asks for the whole run first, and for nothing more while that suffices", () => {
    const state = looked(EMPTY, whole(100), 800, "force");
    expect(state.inFlight).toEqual({ from_s: 0, to_s: 100, points: 800, key: "force" });
    const there = give(state);
    expect(there).toMatchObject({ inFlight: null, fine: null });
    expect(there.overview).not.toBeNull();
    expect(looked(there, whole(100), 800, "force").inFlight).toBeNull();
  });

  it("asks with room on both sides at the density of the screen", () => {
    expect(requestFor(at(40, 60), 800, "force")).toEqual({ from_s: 30, to_s: 70, points: 1600, key: "force" });
    expect(requestFor(at(0, 20), 800, "force")).toMatchObject({ from_s: 0, to_s: 30, points: 1200 });
  });

  it("needs no new samples for a small move", () => {
    const fine = give(looked(opened(), at(40, 50), 800, "force"));
    expect(looked(fine, at(43, 53), 800, "force").inFlight).toBeNull();
    expect(looked(fine, at(48, 58), 800, "force").inFlight).not.toBeNull();
  });

  it("has one request under way and keeps only the latest behind it", () => {
    const first = looked(opened(), at(40, 60), 800, "force");
    const second = looked(first, at(45, 50), 800, "force");
    const third = looked(second, at(46, 47), 800, "force");
    expect(second.inFlight).toBe(first.inFlight);
    expect(third.inFlight).toBe(first.inFlight);
    expect(third.next).toMatchObject({ from_s: 45.5, to_s: 47.5 });
    const then = give(third);
    expect(then.fine?.request).toBe(first.inFlight);
    expect(then.inFlight).toBe(third.next);
  });

  it("gives up what is of no use any more", () => {
    const first = looked(opened(), at(10, 12), 800, "force");
    const far = looked(first, at(80, 82), 800, "force");
    expect(far.inFlight).toMatchObject({ from_s: 79 });
    const late = arrived(far, first.inFlight!, answer(first.inFlight!), RUN);
    expect(late).toBe(far);
    const other = looked(first, at(10, 12), 800, "valve");
    expect(other).toMatchObject({ overview: null, fine: null, inFlight: { key: "valve" } });
  });

  it("never asks for more than single ticks", () => {
    const ticks = give(looked(opened(), at(40, 40.1), 800, "force"), false);
    expect(looked(ticks, at(40.02, 40.03), 800, "force").inFlight).toBeNull();
  });

  it("shows what there is after a failure", () => {
    const asked = looked(opened(), at(40, 60), 800, "force");
    const after = failed(asked, asked.inFlight!);
    expect(after).toMatchObject({ inFlight: null });
    expect(composed(after, { from_s: 40, to_s: 60 })).toBe(after.overview!.samples);
  });
});

describe("composed", () => {
  it("draws the fine stretch with the coarse one on both sides: never an empty edge", () => {
    const state = give(looked(opened(), at(40, 60), 800, "force"));
    const drawn = composed(state, { from_s: 25, to_s: 75 })!;
    expect(drawn.time_s.every((time, i) => i === 0 || time > drawn.time_s[i - 1]!)).toBe(true);
    expect(drawn.channels.force_n!.min).toEqual([800, 800, 800, ...Array(10).fill(1600), 800, 800, 800]);
    expect(composed(state, { from_s: 42, to_s: 58 })).toBe(state.fine!.samples);
    expect(composed(state, { from_s: 0, to_s: 20 })).toBe(state.overview!.samples);
  });

  it("is every tick only where no coarse stretch is beside the ticks", () => {
    const state = give(looked(opened(), at(40, 40.1), 800, "force"), false);
    expect(composed(state, { from_s: 40.02, to_s: 40.08 })!.decimated).toBe(false);
    expect(composed(state, RUN)!.decimated).toBe(true);
  });

  it("is nothing before the first answer", () => {
    expect(composed(EMPTY, RUN)).toBeNull();
  });
});
