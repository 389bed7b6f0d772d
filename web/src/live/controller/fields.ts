// Every value of the controller settings: its name in the paper, its unit, its place in the document. Pure.

import { NOTHING } from "../../units";
import type { Settings } from "./types";

export interface Field {
  /** As the server writes it: `compensator.ff_v`. */
  readonly path: string;
  readonly label: string;
  readonly unit: string;
  readonly hint: string;
  /** May be left empty: no limit. */
  readonly optional?: boolean;
  /** What holds then. */
  readonly empty?: string;
}

export const GAINS: readonly Field[] = [
  { path: "k_p", label: "K_P", unit: "1/N", hint: "Valve command per newton of error" },
  { path: "k_i", label: "K_I", unit: "1/(N s)", hint: "Integral of the error" },
  { path: "k_d", label: "K_D", unit: "s/N", hint: "Derivative of the filtered error" },
  { path: "derivative_hz", label: "Derivative corner", unit: "Hz", hint: "Corner of the derivative's filter" },
  { path: "k_ff", label: "K_FF", unit: "s/N", hint: "On the change of the setpoint" },
  { path: "valve_limit", label: "Valve limit", unit: "0…1", hint: "Saturation of the valve command, 0…1" },
  { path: "valve_slew_per_s", label: "Valve slew", unit: "1/s", hint: "Empty: no limit", optional: true, empty: "no limit" },
];

export const BRANCH: readonly Field[] = [
  { path: "compensator.ff_v", label: "FF_V", unit: "s/m", hint: "Valve command per velocity" },
  { path: "compensator.ff_a", label: "FF_A", unit: "s²/m", hint: "Valve command per acceleration" },
  { path: "compensator.lead_zero_hz", label: "Lead zero", unit: "Hz", hint: "f_z of the lead" },
  { path: "compensator.lead_pole_hz", label: "Lead pole", unit: "Hz", hint: "f_p of the lead" },
  { path: "compensator.low_pass_hz", label: "Low-pass", unit: "Hz", hint: "Corner of the low-pass" },
  { path: "compensator.low_pass_order", label: "Low-pass order", unit: "", hint: "1 or 2" },
  { path: "compensator.low_pass_damping", label: "Low-pass damping", unit: "", hint: "Of order 2 only", optional: true, empty: "order 2 only" },
  { path: "compensator.notch_damping", label: "Notch damping ζ_d", unit: "", hint: "Half the width of the notch" },
  { path: "compensator.fade_s", label: "Fade", unit: "s", hint: "How long the branch takes to join or leave" },
];

const ALL = [...GAINS, ...BRANCH];
const LOW_PASS_DAMPING = 0.7;

export const fieldOf = (path: string): Field =>
  ALL.find((field) => field.path === path) ?? { path, label: path, unit: "", hint: "" };

export function valueAt(settings: Settings, path: string): number | null {
  const [name = "", inner] = path.split(".");
  const outer = settings as unknown as Record<string, unknown>;
  const value = inner === undefined ? outer[name] : (outer[name] as Record<string, unknown>)[inner];
  return typeof value === "number" ? value : null;
}

/** The settings with one value changed; a low-pass of order 1 has no damping, one of order 2 begins with some. */
export function withValue(settings: Settings, path: string, value: number | null): Settings {
  const [name = "", inner] = path.split(".");
  if (inner === undefined) return { ...settings, [name]: value };
  const compensator = { ...settings.compensator, [inner]: value };
  if (inner === "low_pass_order") compensator.low_pass_damping = value === 2 ? LOW_PASS_DAMPING : null;
  return { ...settings, compensator };
}

export interface ShownChange {
  readonly path: string;
  readonly label: string;
  readonly before: string;
  readonly after: string;
}

export function changesBetween(before: Settings, after: Settings): readonly ShownChange[] {
  return ALL.flatMap(({ path, label, unit }) => {
    const [was, is] = [valueAt(before, path), valueAt(after, path)];
    return was === is ? [] : [{ path, label, before: written(was, unit), after: written(is, unit) }];
  });
}

/** A value with its unit, with as many digits as it has. */
export function written(value: unknown, unit: string): string {
  if (value === null || value === undefined) return NOTHING;
  const text = typeof value === "number" ? String(Number(value.toPrecision(7))).replace("-", "\u2212") : String(value);
  return unit === "" ? text : `${text}\u00a0${unit}`;
}
