// How near a detector's value is to its limit, as a bar. Pure: everything in shares of the bar, 0 left to 1 right.

import type { Detector } from "./types";

type Limits = Pick<Detector, "comparison" | "threshold" | "low">;

export type Nearness = "within" | "near" | "beyond";

/** Below this share of what a limit allows, a margin is small. It colours; the loop judges by the limit alone. */
export const SMALL = 0.1;

/** @param margin the share of a limit that is left, from the server: 0 at the limit, below it beyond. */
export function nearnessOf(margin: number | null): Nearness {
  if (margin === null) return "within";
  return margin < 0 ? "beyond" : margin < SMALL ? "near" : "within";
}

export interface MarginBar {
  /** From where it is at rest to the value. */
  readonly bar: readonly [number, number];
  /** The limits, where they lie on the bar. */
  readonly limits: readonly number[];
  /** The stretches beyond the limits. */
  readonly beyond: readonly (readonly [number, number])[];
}

const OVER = 0.15; // of the bar lies beyond a limit: it can be seen how far

/** The bar of a value beside its limits; null where there is no figure to draw. */
export function barOf({ comparison, threshold, low }: Limits, value: number | null): MarginBar | null {
  if (value === null || !Number.isFinite(value)) return null;
  const reachOf = Math.abs(threshold) || 1;
  if (comparison === "magnitude_above") return twoSided(-threshold, threshold, 0, value);
  if (comparison === "outside") return twoSided(low ?? -threshold, threshold, (threshold + (low ?? -threshold)) / 2, value);
  const at = comparison === "above" ? reaching(Math.min(0, threshold - reachOf), threshold) : placed(Math.min(0, threshold), threshold + reachOf);
  const limit = at(threshold);
  return { bar: [0, at(value)], limits: [limit], beyond: [comparison === "above" ? [limit, 1] : [0, limit]] };
}

function twoSided(low: number, high: number, rest: number, value: number): MarginBar {
  const over = OVER * (high - low || 1);
  const at = placed(low - over, high + over);
  const ends: [number, number] = [at(low), at(high)];
  return { bar: span(at(rest), at(value)), limits: ends, beyond: [[0, ends[0]], [ends[1], 1]] };
}

const placed =
  (low: number, high: number) =>
  (value: number): number =>
    Math.min(1, Math.max(0, (value - low) / (high - low)));
const reaching = (from: number, limit: number) => placed(from, limit + OVER * (limit - from));
const span = (a: number, b: number): readonly [number, number] => [Math.min(a, b), Math.max(a, b)];
