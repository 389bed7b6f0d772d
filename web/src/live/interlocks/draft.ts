// Changes to a table that is being written. Pure: each returns a new table.

import type { Detector } from "./types";

export type Table = readonly Detector[];

export const MOST = 64;

/** A detector as one begins it: it only indicates until somebody says more. */
export const NEW_DETECTOR: Detector = {
  name: "new_detector",
  quantity: "force_n",
  form: "value",
  comparison: "magnitude_above",
  threshold: 50e3,
  low: null,
  persistence_s: 0,
  horizon_s: null,
  smoothing_s: null,
  action: "indicate",
  armed: ["running", "holding"],
  latching: true,
  enabled: true,
  text: "",
};

/** What takes the load off stays until somebody has looked. */
export const alwaysLatches = ({ action }: Pick<Detector, "action">): boolean => action === "stop" || action === "shutdown";

/** A name that no detector of the table has: `force`, `force_2`, `force_3`. */
export function freeName(table: Table, wanted: string): string {
  const taken = new Set(table.map(({ name }) => name));
  const stem = wanted.replace(/_\d+$/, "");
  for (let number = 1; ; number += 1) {
    const name = number === 1 ? stem : `${stem}_${number}`;
    if (!taken.has(name)) return name;
  }
}

export const added = (table: Table): Table => [
  ...table,
  { ...NEW_DETECTOR, name: freeName(table, NEW_DETECTOR.name) },
];

export const duplicated = (table: Table, at: number): Table =>
  table.toSpliced(at + 1, 0, { ...table[at]!, name: freeName(table, table[at]!.name) });

export const removed = (table: Table, at: number): Table => table.toSpliced(at, 1);

/** Moves a detector by `steps`; where there is no such place, nothing moves. */
export function moved(table: Table, at: number, steps: number): Table {
  const to = at + steps;
  if (to < 0 || to >= table.length) return table;
  return table.toSpliced(at, 1).toSpliced(to, 0, table[at]!);
}

export function changed(table: Table, at: number, changes: Partial<Detector>): Table {
  return table.with(at, consistent({ ...table[at]!, ...changes }));
}

/** What does not belong to the chosen form and comparison is left out, what they need begins with something. */
function consistent(detector: Detector): Detector {
  const { comparison, form, threshold } = detector;
  const reach = Math.abs(threshold) || 1;
  return {
    ...detector,
    low: comparison === "outside" ? (detector.low ?? threshold - 2 * reach) : null,
    horizon_s: form === "look_ahead" ? (detector.horizon_s ?? 0.02) : null,
    smoothing_s: form === "value" ? null : detector.smoothing_s,
    latching: alwaysLatches(detector) || detector.latching,
  };
}
