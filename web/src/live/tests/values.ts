// A value of a definition as one reads it, in the units of the control room where its key has one.

import { quantityOfMeasurement } from "./measurements";
import { isBranch, parsePath } from "./tree";
import { quantityOf, toEntry } from "../../units";

const LONGEST = 120;

/** A value at a path: `2 kN`, `log`, a short list as it is; a dash where there is none. */
export function shownValue(path: string, value: unknown): string {
  if (value === undefined || value === null) return "—";
  if (typeof value === "number") {
    const name = String(parsePath(path).findLast((key) => typeof key === "string") ?? "");
    const quantity = name.startsWith("at_") ? quantityOfMeasurement("") : quantityOf(name);
    return quantity.symbol === "" ? toEntry(quantity, value) : `${toEntry(quantity, value)}\u00a0${quantity.symbol}`;
  }
  if (!isBranch(value)) return String(value);
  const text = JSON.stringify(value).replace(/"/g, "").replace(/,/g, ", ").replace(/:/g, ": ");
  return text.length > LONGEST ? `${text.slice(0, LONGEST)}…` : text;
}
