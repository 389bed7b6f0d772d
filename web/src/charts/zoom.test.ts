import { describe, expect, it } from "vitest";
import {
  byKey,
  closer,
  farther,
  grown,
  jumpTo,
  pan,
  shownWindow,
  whole,
  windowOf,
  writeWindow,
  zoomAt,
  zoomOut,
  zoomTo,
} from "./zoom";

const PERIOD_S = 1 / 4000;
const RUN = { from_s: 0, to_s: 10 };

describe("zoom", () => {
  it("goes closer and back the same way", () => {
    const run = whole(10);
    const once = zoomTo(run, { from_s: 2, to_s: 4 }, PERIOD_S);
    const twice = zoomTo(once, { from_s: 3, to_s: 3.1 }, PERIOD_S);
    expect(shownWindow(twice).from_s).toBeCloseTo(3, 12);
    expect(shownWindow(zoomOut(twice))).toEqual({ from_s: 2, to_s: 4 });
    expect(zoomOut(zoomOut(zoomOut(twice)))).toEqual(run);
  });

  it("ends at single ticks", () => {
    let stack = whole(3600);
    for (let i = 0; i < 40; i += 1) stack = closer(stack, PERIOD_S);
    const { from_s, to_s } = shownWindow(stack);
    expect(to_s - from_s).toBeCloseTo(10 * PERIOD_S, 9);
  });

  it("stays inside the run", () => {
    const stack = zoomTo(whole(10), { from_s: -3, to_s: 2 }, PERIOD_S);
    expect(shownWindow(stack)).toEqual({ from_s: 0, to_s: 5 });
    const right = pan(pan(stack, 0.8), 0.8);
    expect(shownWindow(right)).toEqual({ from_s: 5, to_s: 10 });
    expect(shownWindow(pan(right, -9))).toEqual({ from_s: 0, to_s: 5 });
    expect(pan(whole(10), 0.5)).toEqual(whole(10));
  });

  it("ignores a window that is none", () => {
    const run = whole(10);
    expect(zoomTo(run, { from_s: 4, to_s: 4 }, PERIOD_S)).toBe(run);
    expect(zoomTo(run, { from_s: NaN, to_s: NaN }, PERIOD_S)).toBe(run);
  });

  it("is done with keys, too", () => {
    const near = byKey(whole(8), "+", PERIOD_S)!;
    expect(shownWindow(near)).toEqual({ from_s: 2, to_s: 6 });
    expect(shownWindow(byKey(near, "ArrowRight", PERIOD_S)!)).toEqual({ from_s: 3, to_s: 7 });
    expect(byKey(near, "-", PERIOD_S)).toEqual(whole(8));
    expect(byKey(near, "0", PERIOD_S)).toEqual(whole(8));
    expect(byKey(near, "x", PERIOD_S)).toBeNull();
  });

  it("keeps a bounded way back", () => {
    let stack = whole(3600);
    for (let i = 0; i < 500; i += 1) stack = zoomTo(stack, { from_s: i, to_s: i + 2 }, PERIOD_S);
    expect(stack.length).toBeLessThanOrEqual(51);
    expect(stack[0]).toEqual({ from_s: 0, to_s: 3600 });
  });

  it("comes from an hour to single ticks in one gesture, the moment under the cursor standing still", () => {
    let stack = whole(3600);
    const at_s = 1234.5678;
    for (let i = 0; i < 200; i += 1) {
      const { from_s, to_s } = shownWindow(stack);
      const before = (at_s - from_s) / (to_s - from_s);
      stack = zoomAt(stack, at_s, 0.85, PERIOD_S, i > 0);
      const next = shownWindow(stack);
      expect((at_s - next.from_s) / (next.to_s - next.from_s)).toBeCloseTo(before, 6);
    }
    expect(shownWindow(stack).to_s - shownWindow(stack).from_s).toBeCloseTo(10 * PERIOD_S, 9);
    expect(stack).toHaveLength(2);
    expect(zoomOut(stack)).toEqual(whole(3600));
  });

  it("goes farther until the run is whole, at its ends too", () => {
    let stack = zoomTo(whole(10), { from_s: 0, to_s: 1 }, PERIOD_S);
    stack = zoomAt(stack, 0.5, 2, PERIOD_S, false);
    expect(shownWindow(stack)).toEqual({ from_s: 0, to_s: 2 });
    for (let i = 0; i < 9; i += 1) stack = zoomAt(stack, 0.5, 2, PERIOD_S, true);
    expect(stack).toEqual(whole(10));
    expect(farther(farther(zoomTo(whole(8), { from_s: 3, to_s: 5 }, PERIOD_S)))).toEqual(whole(8));
  });

  it("jumps to a moment, and stays as near as one was", () => {
    expect(shownWindow(jumpTo(whole(60), 30, PERIOD_S))).toEqual({ from_s: 29, to_s: 31 });
    const near = zoomTo(whole(60), { from_s: 1, to_s: 1.5 }, PERIOD_S);
    expect(shownWindow(jumpTo(near, 30, PERIOD_S))).toEqual({ from_s: 29.75, to_s: 30.25 });
    expect(shownWindow(jumpTo(whole(60), 0, PERIOD_S))).toEqual({ from_s: 0, to_s: 2 });
  });

  it("goes to the ends by key", () => {
    const near = zoomTo(whole(60), { from_s: 30, to_s: 32 }, PERIOD_S);
    expect(shownWindow(byKey(near, "Home", PERIOD_S)!)).toEqual({ from_s: 0, to_s: 2 });
    expect(shownWindow(byKey(near, "End", PERIOD_S)!)).toEqual({ from_s: 58, to_s: 60 });
    expect(shownWindow(byKey(near, "ArrowRight", PERIOD_S, true)!)).toEqual({ from_s: 32, to_s: 34 });
  });

  it("follows a run that grows only where one looks at the whole of it", () => {
    const near = zoomTo(whole(10), { from_s: 2, to_s: 3 }, PERIOD_S);
    expect(grown(whole(10), 12)).toEqual(whole(12));
    expect(shownWindow(grown(near, 12))).toEqual({ from_s: 2, to_s: 3 });
    expect(grown(whole(10), 9)).toEqual(whole(10));
  });

  it("stands in the address", () => {
    const query = new URLSearchParams("show=force");
    writeWindow(query, zoomTo(whole(10), { from_s: 2.000250000001, to_s: 2.5 }, PERIOD_S));
    expect(query.toString()).toBe("show=force&from=2.00025&to=2.5");
    expect(windowOf(query, RUN)).toEqual({ from_s: 2.00025, to_s: 2.5 });
    writeWindow(query, whole(10));
    expect(query.toString()).toBe("show=force");
    for (const nonsense of ["from=3&to=2", "from=a&to=b", "from=-1&to=2", "from=11&to=12", ""])
      expect(windowOf(new URLSearchParams(nonsense), RUN)).toBeNull();
    const box = { from_s: -2, to_s: 2 };
    expect(windowOf(new URLSearchParams("from=-1&to=3"), box)).toEqual({ from_s: -1, to_s: 2 });
  });
});
