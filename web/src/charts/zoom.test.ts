import { describe, expect, it } from "vitest";
import { byKey, closer, pan, shownWindow, whole, zoomOut, zoomTo } from "./zoom";

const PERIOD_S = 1 / 4000;

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
});
