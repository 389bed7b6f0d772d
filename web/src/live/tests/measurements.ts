// What a test may be accepted by, and in which units its limits are written in the form.

import { PERCENT, PLAIN, quantityOf, RATIO, type Quantity } from "../../units";

export const MEASUREMENTS: readonly string[] = [
  "force_error_rms_n",
  "force_error_peak_n",
  "peak_force_n",
  "peak_displacement_m",
  "valve_saturation_share",
  "goodness_of_fit",
  "step_overshoot_percent",
  "step_rise_s",
  "step_settling_s",
];

export function quantityOfMeasurement(name: string): Quantity {
  if (name === "goodness_of_fit") return PERCENT;
  if (name.endsWith("_share")) return RATIO;
  const quantity = quantityOf(name);
  return quantity.symbol === "" ? PLAIN : quantity;
}
