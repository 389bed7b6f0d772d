// What a detector watches, in words and in the units that people read. Pure.

import { spoken } from "../../quantities";
import {
  figure,
  FORCE,
  LENGTH,
  NOTHING,
  PERCENT,
  PRESSURE,
  quantityOf,
  RATIO,
  SPEED,
  TIME,
  withUnit,
  type Quantity,
} from "../../units";
import type { Action, Comparison, Detector, DetectorMode, Form, QuantityName } from "./types";

const COUNT: Quantity = { label: "", symbol: "", scale: 1, digits: 0 };

interface Watched {
  readonly label: string;
  readonly quantity: Quantity;
  /** A value that is one of several states, from 0. */
  readonly states?: readonly string[];
}

const SENSOR = ["sound", "no number", "saturated", "frozen", "without noise", "out of range", "implausible"];
const sensor = (label: string): Watched => ({ label, quantity: COUNT, states: SENSOR });

export const WATCHED: Readonly<Record<QuantityName, Watched>> = {
  force_n: { label: "Force", quantity: FORCE },
  force_error_n: { label: "Force error", quantity: FORCE },
  displacement_m: { label: "Displacement", quantity: LENGTH },
  velocity_m_s: { label: "Velocity", quantity: SPEED },
  supply_pressure_pa: { label: "Supply pressure", quantity: PRESSURE },
  load_cell: sensor("Load cell"),
  app_silence_s: { label: "Silence of the console", quantity: TIME },
  deadlines_missed: { label: "Deadlines missed at once", quantity: COUNT },
  lvt: sensor("LVT"),
  lvdt: sensor("LVDT"),
  pressure_sensor: sensor("Pressure sensors"),
  force_error_relative: { label: "Force error of the peak", quantity: RATIO },
  underpeak: { label: "Swing that is missing", quantity: RATIO },
  valve_command: { label: "Valve command", quantity: RATIO },
  valve_saturation: { label: "Valve at its limit", quantity: RATIO },
  cycles: { label: "Cycles of this run", quantity: COUNT },
  twin_residual_n: { label: "Force beside the twin's", quantity: FORCE },
  twin_goodness: { label: "Agreement with the twin", quantity: PERCENT },
  twin_spool: { label: "Spool beside the twin's", quantity: RATIO },
  unrecorded_s: { label: "Not yet on the disk", quantity: TIME },
  chain_open: { label: "Hard-wired chain", quantity: COUNT, states: ["closed", "open"] },
  displacement_error_m: { label: "Displacement error", quantity: LENGTH },
  pressure_1_pa: { label: "Pressure in chamber 1", quantity: PRESSURE },
  pressure_2_pa: { label: "Pressure in chamber 2", quantity: PRESSURE },
};

/** A server that is newer than this page may watch what it has no word for. */
export const watchedOf = (quantity: QuantityName): Watched =>
  Object.hasOwn(WATCHED, quantity) ? WATCHED[quantity] : { label: spoken(quantity), quantity: quantityOf(quantity) };

export const FORMS: Readonly<Record<Form, string>> = {
  value: "its value",
  rate: "its rate",
  look_ahead: "looked ahead",
};
export const COMPARISONS: Readonly<Record<Comparison, string>> = {
  magnitude_above: "magnitude above",
  above: "above",
  below: "below",
  outside: "outside of",
};
export const ACTIONS: Readonly<Record<Action, string>> = {
  indicate: "Indicate",
  hold: "Hold",
  stop: "Stop",
  shutdown: "Shut down",
};
export const MODES: Readonly<Record<DetectorMode, string>> = {
  tripped: "tripped",
  off: "off",
  pressurising: "pressurising",
  ready: "ready",
  running: "running",
  holding: "holding",
  stopping: "stopping",
};
export const ALL_MODES = Object.keys(MODES) as readonly DetectorMode[];

type Measured = Pick<Detector, "quantity" | "form">;

/** How the value of a detector is written: a rate is one a second. */
export function shownQuantity({ quantity, form }: Measured): Quantity {
  const { quantity: plain } = watchedOf(quantity);
  const digits = Math.max(0, plain.digits - 2);
  return form === "rate" ? { ...plain, digits, symbol: `${plain.symbol || "1"}/s` } : plain;
}

/** The states that a detector's value may be; null where it is a figure. */
export const statesOf = ({ quantity, form }: Measured): readonly string[] | null =>
  (form === "value" && watchedOf(quantity).states) || null;

/** `Force`, `Rate of force`, `Displacement in 0.02 s`. */
export function watches({ quantity, form, horizon_s }: Measured & Pick<Detector, "horizon_s">): string {
  const { label } = watchedOf(quantity);
  if (form === "rate") return `Rate of ${lower(label)}`;
  return form === "look_ahead" ? `${label} in ${persistenceText(horizon_s ?? 0)}` : label;
}

const ABBREVIATION = /^[A-Z]{2}/;
const lower = (text: string): string =>
  ABBREVIATION.test(text) ? text : text.slice(0, 1).toLowerCase() + text.slice(1);

/** A value as people read it: a figure with its unit, or the state that it stands for. */
export function valueText(detector: Measured, value: number | null): string {
  if (value === null || !Number.isFinite(value)) return NOTHING;
  const states = statesOf(detector);
  return states === null ? withUnit(shownQuantity(detector), value) : (states[Math.round(value)] ?? NOTHING);
}

/** The limit in one phrase: `± 55.00 kN`, `at least 150.0 bar`, `−5.00 … 5.00 mm`. */
export function limitText(detector: Pick<Detector, "quantity" | "form" | "comparison" | "threshold" | "low">): string {
  const { comparison, threshold, low } = detector;
  if (statesOf(detector) !== null) return statesOf(detector)![0]!;
  const limit = withUnit(shownQuantity(detector), threshold);
  if (comparison === "magnitude_above") return `± ${limit}`;
  if (comparison === "outside") return `${figure(shownQuantity(detector), low)} … ${limit}`;
  return comparison === "below" ? `at least ${limit}` : `at most ${limit}`;
}

/** `at once`, `50 ms`, `15.0 s`. */
export function persistenceText(persistence_s: number): string {
  if (persistence_s <= 0) return "at once";
  return persistence_s < 1 ? `${Number((1000 * persistence_s).toFixed(2))}\u00a0ms` : withUnit(TIME, persistence_s, -1);
}

const KNOWN: readonly (readonly [string, readonly DetectorMode[]])[] = [
  ["always", ALL_MODES],
  ["under pressure", ["pressurising", "ready", "running", "holding", "stopping"]],
  ["pressure is up", ["ready", "running", "holding", "stopping"]],
  ["can be loaded", ["ready", "running", "holding"]],
  ["under load", ["running", "holding", "stopping"]],
  ["in a test", ["running", "holding"]],
];

/** When a detector is armed: `always`, `in a test`, or the states themselves. */
export function armedText(armed: readonly DetectorMode[]): string {
  const known = KNOWN.find(([, modes]) => modes.length === armed.length && modes.every((mode) => armed.includes(mode)));
  if (known) return known[0];
  return armed.length === 0 ? "never" : ALL_MODES.filter((mode) => armed.includes(mode)).join(", ");
}

/** How long something must last, as one types it. */
export const MILLISECONDS: Quantity = { label: "", symbol: "ms", scale: 1e3, digits: 0 };
