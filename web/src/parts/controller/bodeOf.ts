// Loops and branches as the Bode chart draws them. Pure.

import type { BodeModel, BodePoint, BodeSeries } from "../../charts/bode";
import type { CompensatorSheet, LoopResponse } from "../../live/controller/types";

export { marginMarks } from "../../live/responses/margins";

type Frequencies = readonly (number | null)[];

const FLOOR_DB = -60; // a notch has none at its centre
const gainOf = (db: number): number => 10 ** (Math.max(db, FLOOR_DB) / 20);

export function pointsOf(frequencies_hz: Frequencies, { gain_db, phase_deg }: LoopResponse): BodePoint[] {
  return frequencies_hz.flatMap((frequency_hz, i) => {
    const [db, degrees] = [gain_db[i], phase_deg[i]];
    if (frequency_hz === null || typeof db !== "number" || typeof degrees !== "number") return [];
    return [{ frequency_hz, gain: gainOf(db), phase_deg: degrees }];
  });
}

export function modelOf(frequencies_hz: Frequencies, response: LoopResponse, of: number): BodeModel {
  const points = pointsOf(frequencies_hz, response);
  return {
    of,
    frequencies_hz: points.map(({ frequency_hz }) => frequency_hz),
    gain: points.map(({ gain }) => gain),
    phase_deg: points.map(({ phase_deg }) => phase_deg),
  };
}

/** The branch, filter by filter (figure 11). */
export function branchSeries(sheet: CompensatorSheet): BodeSeries[] {
  const { frequencies_hz, lead, low_pass, notch, whole } = sheet;
  return [
    { label: "Whole", points: pointsOf(frequencies_hz, whole) },
    { label: "Lead", points: pointsOf(frequencies_hz, lead) },
    { label: "Low-pass", points: pointsOf(frequencies_hz, low_pass) },
    { label: "Notch", points: pointsOf(frequencies_hz, notch) },
  ];
}
