// First-outs in words. Pure.

import { count, NOTHING } from "../../units";
import type { Detector } from "../interlocks/types";
import type { FirstOutDetail, TripKept } from "./types";

interface Tripped {
  readonly tick: number;
  readonly first: boolean;
}

/** The first-out on top, then what tripped with and after it. */
export const inOrderOfTripping = <T extends Tripped>(trips: readonly T[]): readonly T[] =>
  [...trips].sort((a, b) => Number(b.first) - Number(a.first) || a.tick - b.tick);

/** How long after the first-out something tripped: `same tick`, `+3 ticks, 0.75 ms`, `+1.20 s`. */
export function afterFirst(first: number, tick: number, period_s: number | null): string {
  const ticks = tick - first;
  if (ticks === 0) return "same tick";
  const sign = ticks < 0 ? "\u2212" : "+";
  if (period_s === null) return `${sign}${count(Math.abs(ticks))} ticks`;
  return Math.abs(ticks * period_s) < 1 ? inMilliseconds(ticks, period_s) : `${sign}${Math.abs(ticks * period_s).toFixed(2)}\u00a0s`;
}

function inMilliseconds(ticks: number, period_s: number): string {
  const sign = ticks < 0 ? "\u2212" : "+";
  const many = Math.abs(ticks) === 1 ? "tick" : "ticks";
  return `${sign}${count(Math.abs(ticks))} ${many}, ${Math.abs(1e3 * ticks * period_s).toFixed(2)}\u00a0ms`;
}

/** A time around the first-out, as one reads it: `−12.25 ms`, `+1.200 s`. */
export function timeText(time_s: number | null): string {
  if (time_s === null) return NOTHING;
  const sign = time_s < 0 ? "\u2212" : "+";
  const size = Math.abs(time_s);
  if (time_s === 0) return "0";
  return size < 0.1 ? `${sign}${(1e3 * size).toFixed(2)}\u00a0ms` : `${sign}${size.toFixed(3)}\u00a0s`;
}

/** Channels on which the value of a quantity can be seen, where the limits of its detectors belong. */
const CHARTED: Readonly<Record<string, string>> = {
  force_n: "force",
  force_error_n: "error",
  displacement_m: "displacement",
  velocity_m_s: "velocity",
  valve_command: "valve",
  supply_pressure_pa: "pressures",
  pressure_1_pa: "pressures",
  pressure_2_pa: "pressures",
};

type Drawn = Pick<Detector, "quantity" | "form" | "comparison" | "threshold" | "low" | "enabled">;

/** The limits to draw on each chart: those of the detectors that judge just what is drawn there. */
export function limitsByChart(detectors: readonly Drawn[]): Readonly<Record<string, readonly number[]>> {
  const limits: Record<string, number[]> = {};
  for (const { quantity, form, comparison, threshold, low, enabled } of detectors) {
    const chart = CHARTED[quantity];
    if (chart === undefined || form !== "value" || !enabled) continue;
    const both = comparison === "magnitude_above" ? [-threshold, threshold] : [threshold];
    limits[chart] = [...(limits[chart] ?? []), ...both, ...(comparison === "outside" && low !== null ? [low] : [])];
  }
  return limits;
}

/** The charts that tell most of a first-out: the one of what tripped, and force, displacement, valve. */
export function chartsFor({ quantity }: Pick<FirstOutDetail, "quantity">): readonly string[] {
  const own = CHARTED[quantity] ?? "force";
  return [...new Set([own, "force", "displacement", "valve"])].slice(0, 3);
}

/** One detector over the recording: when it tripped, and when it would have. */
export interface Compared {
  readonly detector: string;
  readonly recorded: TripKept | null;
  readonly changed: TripKept | null;
}

/** The trips of both, detector by detector, the earliest on top. */
export function compared(recorded: readonly TripKept[], changed: readonly TripKept[]): readonly Compared[] {
  const find = (trips: readonly TripKept[], name: string): TripKept | null =>
    trips.find(({ detector }) => detector === name) ?? null;
  const names = [...new Set([...recorded, ...changed].map(({ detector }) => detector))];
  const rows = names.map((detector) => ({
    detector,
    recorded: find(recorded, detector),
    changed: find(changed, detector),
  }));
  const at = ({ recorded: was, changed: is }: Compared): number => Math.min(was?.time_s ?? Infinity, is?.time_s ?? Infinity);
  return rows.sort((a, b) => at(a) - at(b));
}
