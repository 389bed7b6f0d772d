// What a prediction says in figures, in the order in which one asks. Pure.

import { inUnit } from "../../quantities";
import { duration, FORCE, LENGTH, PRESSURE, RATIO, SPEED, withUnit } from "../../units";
import type { Prediction } from "../../live/types";

export interface Fact {
  readonly label: string;
  readonly text: string;
}

type Length = Pick<Prediction, "duration_s" | "predicted_s" | "outcome" | "shortened">;

/** Whether the test itself ends early: one that measures only until it is sure. */
const endsEarly = ({ duration_s, predicted_s, outcome, shortened }: Length): boolean =>
  outcome === "completed" && shortened.length === 0 && predicted_s < duration_s;

/** How much of a test was computed, where that is not all of it; "" where it is. */
export function computed(prediction: Length): string {
  const { duration_s, predicted_s } = prediction;
  if (predicted_s >= duration_s) return "";
  if (endsEarly(prediction)) return `Ends early: after ${duration(duration_s)} at the latest.`;
  return `Computed: ${duration(predicted_s)} of ${duration(duration_s)}.`;
}

export function predictionFacts(prediction: Prediction): readonly Fact[] {
  const { duration_s, predicted_s, peaks, valve } = prediction;
  const early = endsEarly(prediction);
  return [
    { label: "Duration", text: early ? `about ${duration(predicted_s)}` : duration(duration_s) },
    { label: "Peak force", text: withUnit(FORCE, peaks.force_n) },
    { label: "Displacement", text: withUnit(LENGTH, peaks.displacement_m) },
    { label: "Velocity", text: withUnit(SPEED, peaks.velocity_m_s) },
    { label: "Force error", text: withUnit(FORCE, peaks.force_error_n) },
    { label: "Supply flow", text: inUnit(peaks.supply_flow_m3_s, "m³/s") },
    { label: "Supply droop", text: withUnit(PRESSURE, peaks.pressure_droop_pa) },
    { label: "Valve", text: withUnit(RATIO, valve.peak) },
    { label: "Saturated", text: saturation(valve) },
  ];
}

function saturation({ saturation_share, longest_saturation_s }: Prediction["valve"]): string {
  if (saturation_share === 0) return "never";
  return `${withUnit(RATIO, saturation_share)}, ${(1000 * longest_saturation_s).toFixed(1)}\u00a0ms at once`;
}
