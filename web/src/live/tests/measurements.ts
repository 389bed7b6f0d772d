// What a test may be accepted by, and in which units its limits are written in the form.

import { MEASUREMENTS } from "../../gen/measurements";
import { quantityOfUnit } from "../../quantities";
import { ANGLE, type Quantity } from "../../units";

const BY_NAME = new Map<string, { readonly unit: string; readonly doc: string }>(
  MEASUREMENTS.map((one) => [one.name, one]),
);

export const MEASUREMENT_NAMES: readonly string[] = [...BY_NAME.keys()];

export const aboutMeasurement = (name: string): string => BY_NAME.get(name)?.doc ?? "";

export function quantityOfMeasurement(name: string): Quantity {
  const unit = BY_NAME.get(name)?.unit ?? "1";
  return unit === "°" ? ANGLE : quantityOfUnit(unit, name);
}
