// A frequency response as the backend tells it, for the chart. Pure.

import type { BodeModel, BodeSeries } from "../../charts/bode";
import { FORCE, LENGTH, toEntry, type Quantity } from "../../units";
import { marginMarks } from "./margins";
import type { FrequencyResponse, ResponseSeries, TransferName } from "./types";

/** What a person calls a transfer: output to input. */
export const TRANSFER_NAMES: Readonly<Record<TransferName, { readonly label: string; readonly says: string }>> = {
  force: { label: "Force", says: "Force to its setpoint: the closed loop" },
  plant: { label: "Plant", says: "Force to valve command" },
  motion: { label: "Motion", says: "Rod velocity to valve command" },
  disturbance: { label: "Disturbance", says: "Force to rod velocity: what a motion does to the force" },
  compliance: { label: "Compliance", says: "Displacement of the unit to force" },
  position: { label: "Position", says: "Displacement of the unit to its command" },
  stiffness: { label: "Stiffness", says: "Dynamic stiffness of the unit: force on it to its deformation" },
  admittance: { label: "Admittance", says: "Velocity of the unit's deformation to the force on it" },
  loop: { label: "Open loop", says: "Open loop: the measured plant under the run's own controller" },
};

const METHODS = { stepped_sine: "stepped sine", multisine: "multisine", sweep: "sweep" } as const;
const say = (quantity: Quantity, value: number): string =>
  `${toEntry(quantity, Number(value.toPrecision(3)))}\u00a0${quantity.symbol}`;
const force = (newtons: number): string => say(FORCE, newtons);

/** What tells a series apart from the others: its amplitude, and mean, method and block where they differ.
 *  Of a motion its amplitude and the force under which it was. */
export function seriesLabel(one: ResponseSeries, all: readonly ResponseSeries[]): string {
  const differ = (of: (series: ResponseSeries) => unknown): boolean => new Set(all.map(of)).size > 1;
  const same = all.filter((other) => other.amplitude_n === one.amplitude_n && other.mean_n === one.mean_n);
  return [
    ...(one.amplitude_m === null
      ? [force(one.amplitude_n), ...(differ(({ mean_n }) => mean_n) ? [`about ${force(one.mean_n)}`] : [])]
      : [say(LENGTH, one.amplitude_m), `under ${force(one.mean_n)}`]),
    ...(differ(({ method }) => method) ? [METHODS[one.method]] : []),
    ...(same.length > 1 && !differ(({ method }) => method) ? [`${one.amplitude_m === null ? "block" : "motion"} ${one.block + 1}`] : []),
  ].join(" ");
}

export function bodeSeries({ series, margins }: FrequencyResponse): readonly BodeSeries[] {
  return series.map((one, i) => ({
    label: seriesLabel(one, series),
    points: one.points,
    extremes: [one.extremes.peak, one.extremes.dip, ...(margins[i] ? marginMarks(margins[i]) : [])].filter(
      (extreme) => extreme != null,
    ),
  }));
}

/** The model's curves, each in the colour of the series that it stands behind. */
export function bodeModels({ series, model }: FrequencyResponse): readonly BodeModel[] {
  return model.map(({ amplitude_n, mean_n, ...curve }) => {
    const of = series.findIndex((one) => one.amplitude_n === amplitude_n && one.mean_n === mean_n);
    return of < 0 ? curve : { ...curve, of };
  });
}

/** How many points there are, and how many of them still move. */
export function counted({ series }: FrequencyResponse): { readonly points: number; readonly moving: number } {
  const all = series.flatMap(({ points }) => points);
  return { points: all.length, moving: all.filter(({ settled }) => !settled).length };
}
