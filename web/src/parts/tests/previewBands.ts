// The preview as the bands that charts draw, its highest point, and the blocks that are in view. Pure.

import type { Preview, TimedOutline } from "../../live/tests/types";
import type { TimeWindow } from "../../charts/zoom";

export interface Band {
  readonly time_s: readonly number[];
  readonly min: readonly number[];
  readonly max: readonly number[];
}

export interface Peak {
  readonly time_s: number;
  readonly value: number;
}

export interface BlockMark {
  readonly from_s: number;
  readonly to_s: number;
  /** As a person counts. */
  readonly number: number;
}

export const forceBand = (preview: Preview): Band => ({
  time_s: preview.time_s,
  min: preview.force_min_n,
  max: preview.force_max_n,
});

export const displacementBand = (preview: Preview): Band => ({
  time_s: preview.time_s,
  min: preview.displacement_min_m,
  max: preview.displacement_max_m,
});

/** The value farthest from zero, the first of several; null where the band is empty or zero throughout. */
export function peakOf({ time_s, min, max }: Band): Peak | null {
  let peak: Peak | null = null;
  time_s.forEach((at, i) => {
    for (const value of [max[i], min[i]]) {
      if (value !== undefined && Math.abs(value) > Math.abs(peak?.value ?? 0) * (1 + 1e-9))
        peak = { time_s: at, value };
    }
  });
  return peak;
}

/** Least and greatest value of a band; NaN where it is empty. */
export function extentOf({ min, max }: Band): { low: number; high: number } {
  const low = min.reduce((least, value) => Math.min(least, value), Infinity);
  const high = max.reduce((most, value) => Math.max(most, value), -Infinity);
  return low <= high ? { low, high } : { low: NaN, high: NaN };
}

/** The blocks that are in view, with the part of the test that each takes. */
export function marksIn(blocks: readonly TimedOutline[], shown: TimeWindow): BlockMark[] {
  const marks = blocks.map(({ index, start_s, duration_s }) => ({
    ...{ from_s: start_s, to_s: start_s + duration_s },
    number: index + 1,
  }));
  return marks.filter(({ from_s, to_s }) => to_s > shown.from_s && from_s < shown.to_s);
}
