// Which values of a detector can be changed in a replay, and how each is written. Pure.

import type { Detector } from "../interlocks/types";
import { MILLISECONDS, shownQuantity, statesOf } from "../interlocks/words";
import type { Quantity } from "../../units";

export type FieldName = "threshold" | "low" | "persistence_s" | "action" | "enabled";

export interface Field {
  readonly name: FieldName;
  readonly label: string;
  /** Null for what is chosen, not typed. */
  readonly quantity: Quantity | null;
}

/** The values that mean something for this detector. */
export function fieldsOf(detector: Detector): readonly Field[] {
  const figure = statesOf(detector) === null;
  const quantity = shownQuantity(detector);
  return [
    ...(figure ? [{ name: "threshold", label: "Limit", quantity } as const] : []),
    ...(detector.comparison === "outside" ? [{ name: "low", label: "Lower limit", quantity } as const] : []),
    { name: "persistence_s", label: "Persistence", quantity: MILLISECONDS },
    { name: "action", label: "Action", quantity: null },
    { name: "enabled", label: "Switched", quantity: null },
  ];
}
