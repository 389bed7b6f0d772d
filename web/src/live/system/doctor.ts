// Findings of the doctor in the order in which one should look at them. Pure.

import type { Diagnosis } from "./types";

type Finding = Diagnosis["findings"][number];

/** From the worst to the best. */
export const GRADES: Readonly<Record<string, string>> = {
  unfit: "Unfit",
  limited: "Limited",
  unknown: "Not known",
  good: "Good",
};

export function byGravity(findings: readonly Finding[]): Finding[] {
  const order = Object.keys(GRADES);
  return findings.toSorted((a, b) => order.indexOf(a.grade) - order.indexOf(b.grade));
}
