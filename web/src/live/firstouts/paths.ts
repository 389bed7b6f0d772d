// Every value of the rig, its controller and its interlocks that a re-run can change, by its path. Pure.

import { spoken } from "../../quantities";
import { quantityOf, toEntry, withUnit, type Quantity } from "../../units";
import type { Detector } from "../interlocks/types";
import { MILLISECONDS, shownQuantity } from "../interlocks/words";
import type { Json } from "../tests/tree";
import type { KeptSettings } from "./types";

export interface Settable {
  readonly path: string;
  /** `Rig, supply: high`. */
  readonly label: string;
  readonly value: Json;
  readonly quantity: Quantity;
}

export function settables({ controller, rig, interlocks }: KeptSettings): readonly Settable[] {
  return [
    ...leaves("controller", controller),
    ...(interlocks?.detectors ?? []).flatMap(detectorLeaves),
    ...leaves("rig", rig),
  ];
}

function leaves(path: string, value: Json): Settable[] {
  if (typeof value === "object" && value !== null && !Array.isArray(value))
    return Object.entries(value).flatMap(([key, below]) => leaves(`${path}.${key}`, below));
  const name = path.slice(path.lastIndexOf(".") + 1);
  return Array.isArray(value) ? [] : [{ path, label: labelOf(path), value, quantity: quantityOf(name) }];
}

const CHANGED = ["threshold", "low", "persistence_s", "horizon_s", "smoothing_s", "action", "enabled"] as const;
const TIMES: ReadonlySet<string> = new Set(["persistence_s", "horizon_s", "smoothing_s"]);

function detectorLeaves(detector: Detector): Settable[] {
  return CHANGED.filter((key) => detector[key] !== null && detector[key] !== undefined).map((key) => ({
    path: `interlocks.${detector.name}.${key}`,
    label: labelOf(`interlocks.${detector.name}.${key}`),
    value: detector[key],
    quantity: TIMES.has(key) ? MILLISECONDS : shownQuantity(detector),
  }));
}

const labelOf = (path: string): string => {
  const words = path.split(".").map(spoken);
  return `${words.slice(0, -1).join(", ")}: ${words.at(-1)!.toLowerCase()}`;
};

/** Those that have all of the words, in path or label. */
export function found(all: readonly Settable[], text: string): readonly Settable[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return all.filter(({ path, label }) => {
    const hay = `${path} ${label}`.toLowerCase();
    return words.every((word) => hay.includes(word));
  });
}

/** The present value as one reads it. */
export function shown({ value, quantity }: Settable): string {
  if (typeof value === "number")
    return quantity.symbol === "" ? toEntry(quantity, value) : withUnit(quantity, value, 1);
  return value === null ? "none" : String(value);
}
