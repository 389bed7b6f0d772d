// What the strip on every page says of faults that are injected. Pure.

import type { DrillSummary } from "./types";

/** `load cell frozen is injected by Eva.`; without a name where the newest record is of another fault. */
export function injectedWords(faults: readonly string[], records: readonly DrillSummary[]): string {
  const named = faults.map((name) => name.replaceAll("_", " ")).join(", ");
  const by = records.find(({ fault }) => faults.includes(fault))?.given_by;
  return `${named} ${faults.length === 1 ? "is" : "are"} injected${by === undefined ? "" : ` by ${by}`}.`;
}
