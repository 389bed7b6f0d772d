// Parameters of all sizes as text: five significant digits, SI.

import { NOTHING } from "../../units";

const POWERS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const raised = (power: number): string => `${power < 0 ? "⁻" : ""}${[...String(Math.abs(power))].map((digit) => POWERS[Number(digit)]).join("")}`;

/** `1.2073·10⁸`, `8.5·10⁻⁴`, `−7.92·10⁻⁶`. */
export function si(value: number, digits = 5): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const sign = value < 0 ? "−" : "";
  if (size >= 1e-3 && size < 1e5) return sign + String(Number(size.toPrecision(digits)));
  const [mantissa, power] = size.toExponential(digits - 1).split("e") as [string, string];
  return `${sign}${String(Number(mantissa))}·10${raised(Number(power))}`;
}

/** A value of the rig configuration with its unit: `1.5·10⁸ N/m`; a dash where there is none. */
export function written(value: number | string | boolean | null | undefined, unit: string): string {
  if (value === null || value === undefined || value === "") return NOTHING;
  const text = typeof value === "number" ? si(value, 7) : String(value);
  return unit === "" ? text : `${text}\u00a0${unit}`;
}
