// Rows of the table, in its own order or the least margin first. Pure.

import type { Detector, DetectorState, LiveDetector } from "./types";

export interface Row {
  readonly detector: Detector;
  /** Its place in the table, from 0. */
  readonly place: number;
  readonly live: LiveDetector | null;
  /** Share of the limit that is left; null where nothing is known. */
  readonly margin: number | null;
}

export type Order = "table" | "margin";

export function rowsOf(detectors: readonly Detector[], live: readonly LiveDetector[]): readonly Row[] {
  const byName = new Map(live.map((entry) => [entry.name, entry]));
  return detectors.map((detector, place) => {
    const entry = byName.get(detector.name) ?? null;
    return { detector, place, live: entry, margin: entry?.margin_share ?? null };
  });
}

const URGENCY: Readonly<Record<DetectorState, number>> = {
  tripped: 0,
  counting: 1,
  content: 2,
  not_armed: 3,
  off: 4,
};

/** What has tripped or counts stands first, what is not armed last; in between the least margin on top. */
export function ordered(rows: readonly Row[], order: Order): readonly Row[] {
  if (order === "table") return rows;
  const urgency = ({ live }: Row): number => (live === null ? 5 : URGENCY[live.state]);
  return [...rows].sort(
    (a, b) => urgency(a) - urgency(b) || (a.margin ?? Infinity) - (b.margin ?? Infinity) || a.place - b.place,
  );
}

/** The same rows in a sequence of names that was settled before: nothing jumps about while one reads. */
export function arranged(rows: readonly Row[], names: readonly string[]): readonly Row[] {
  const places = new Map(names.map((name, place) => [name, place]));
  const place = ({ detector, place: own }: Row): number => places.get(detector.name) ?? names.length + own;
  return [...rows].sort((a, b) => place(a) - place(b));
}
