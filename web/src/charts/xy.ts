// Force over displacement. Tick by tick it is a path; from afar each column is the box of its extremes. Pure.

import type { RunSamples } from "../live/types";
import type { TimeWindow } from "./zoom";

export interface Box {
  readonly x: readonly [number, number];
  readonly y: readonly [number, number];
}

/** One box a column within the window, in order of time; of a single tick it is a point. Gaps are left out. */
export function boxes(samples: RunSamples, x: string, y: string, { from_s, to_s }: TimeWindow): readonly Box[] {
  const [across, up] = [samples.channels[x], samples.channels[y]];
  if (!across || !up) return [];
  return samples.time_s.flatMap((time, i): Box[] => {
    const [left, right, low, high] = [across.min[i], across.max[i], up.min[i], up.max[i]];
    if (time < from_s || time > to_s) return [];
    if (![left, right, low, high].every((value) => typeof value === "number")) return [];
    return [{ x: [left!, right!], y: [low!, high!] }];
  });
}

/** What all boxes lie within; null where there are none. */
export function around(all: readonly Box[]): Box | null {
  if (all.length === 0) return null;
  const [x, y] = [
    [Infinity, -Infinity],
    [Infinity, -Infinity],
  ] as [[number, number], [number, number]];
  for (const box of all) {
    x[0] = Math.min(x[0], box.x[0]);
    x[1] = Math.max(x[1], box.x[1]);
    y[0] = Math.min(y[0], box.y[0]);
    y[1] = Math.max(y[1], box.y[1]);
  }
  return { x, y };
}
