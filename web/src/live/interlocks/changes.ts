// What differs between two tables of detectors, in words. Pure.

import { spoken } from "../../quantities";
import { figure, NOTHING, TIME, withUnit } from "../../units";
import type { Detector } from "./types";
import {
  ACTIONS,
  armedText,
  COMPARISONS,
  FORMS,
  persistenceText,
  shownQuantity,
  watchedOf,
} from "./words";

export interface Change {
  /** The name of the detector; empty where it is about the table. */
  readonly detector: string;
  readonly what: string;
  /** Both empty where the words of `what` say it all. */
  readonly before: string;
  readonly after: string;
}

const FIELDS: { readonly [Key in keyof Omit<Detector, "name">]: readonly [string, (detector: Detector) => string] } = {
  quantity: ["watches", ({ quantity }) => watchedOf(quantity).label],
  form: ["judges", ({ form }) => FORMS[form]],
  comparison: ["is violated", ({ comparison }) => COMPARISONS[comparison]],
  low: ["lower limit", (detector) => limit(detector, detector.low)],
  threshold: ["limit", (detector) => limit(detector, detector.threshold)],
  persistence_s: ["persistence", ({ persistence_s }) => persistenceText(persistence_s)],
  horizon_s: ["looks ahead", ({ horizon_s }) => time(horizon_s)],
  smoothing_s: ["smoothing", ({ smoothing_s }) => time(smoothing_s)],
  action: ["action", ({ action }) => ACTIONS[action]],
  armed: ["armed", ({ armed }) => armedText(armed)],
  latching: ["latches", ({ latching }) => (latching ? "yes" : "no")],
  enabled: ["switched", ({ enabled }) => (enabled ? "on" : "off")],
  text: ["text", ({ text }) => text || NOTHING],
};

const limit = (detector: Detector, value: number | null): string =>
  value === null || figure(shownQuantity(detector), value) === NOTHING
    ? "none"
    : withUnit(shownQuantity(detector), value, 1);
const time = (value_s: number | null): string => (value_s === null ? "none" : withUnit(TIME, value_s, 1));

/** Detectors are told apart by their names; the order of the table is told, too: of two in one tick it decides. */
export function changesBetween(before: readonly Detector[], after: readonly Detector[]): readonly Change[] {
  const was = new Map(before.map((detector) => [detector.name, detector]));
  const is = new Map(after.map((detector) => [detector.name, detector]));
  const removed = before.filter(({ name }) => !is.has(name)).map(({ name }) => plain(name, "removed"));
  const others = after.flatMap((detector) => {
    const old = was.get(detector.name);
    return old === undefined ? [plain(detector.name, "added")] : changed(old, detector);
  });
  const all = [...removed, ...others];
  return inOtherOrder(before, after) ? [...all, plain("", "another order")] : all;
}

const plain = (detector: string, what: string): Change => ({ detector, what, before: "", after: "" });

function changed(old: Detector, detector: Detector): Change[] {
  return (Object.keys(FIELDS) as (keyof typeof FIELDS)[]).flatMap((key) => {
    const [what, write] = FIELDS[key];
    if (same(old[key], detector[key])) return [];
    return [{ detector: detector.name, what, before: write(old), after: write(detector) }];
  });
}

const same = (a: unknown, b: unknown): boolean =>
  Array.isArray(a) && Array.isArray(b)
    ? [...a].sort().join() === [...b].sort().join()
    : Object.is(a ?? null, b ?? null);

function inOtherOrder(before: readonly Detector[], after: readonly Detector[]): boolean {
  const names = (list: readonly Detector[], other: readonly Detector[]): string =>
    list.map(({ name }) => name).filter((name) => other.some((one) => one.name === name)).join();
  return names(before, after) !== names(after, before);
}

/** One change as a sentence: `Force: limit 55.00 kN, was 50.00 kN`. */
export function sentence({ detector, what, before, after }: Change): string {
  const about = detector === "" ? "The table" : spoken(detector);
  return before === "" && after === "" ? `${about}: ${what}` : `${about}: ${what} ${after}, was ${before}`;
}
