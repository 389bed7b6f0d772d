import { describe, expect, it } from "vitest";
import { place, type Callout } from "./callouts";

const ROOM = { width: 400, height: 200, size: 12 };
const label = (x: number, y: number, above = true): Callout => ({ x, y, width: 80, above });

describe("labels of points", () => {
  it("stand above a peak and below a dip", () => {
    const [peak, dip] = place([label(100, 100), label(300, 100, false)], ROOM);
    expect(peak!.top + ROOM.size).toBeLessThan(100);
    expect(dip!.top).toBeGreaterThan(100);
  });
  it("stay inside: beside the edge, and under a peak at the very top", () => {
    const [corner] = place([label(2, 3)], ROOM);
    expect(corner!.left).toBe(0);
    expect(corner!.top).toBeGreaterThan(3);
  });
  it("do not cover each other", () => {
    const placed = place([label(100, 100), label(120, 102), label(90, 98)], ROOM);
    const tops = placed.map((spot) => spot!.top).sort((a, b) => a - b);
    tops.slice(1).forEach((top, i) => expect(top - tops[i]!).toBeGreaterThanOrEqual(ROOM.size));
  });
  it("are left out where there is no room", () => {
    expect(place([label(10, 5), label(10, 5)], { ...ROOM, height: 15 })).toContain(null);
  });
});
