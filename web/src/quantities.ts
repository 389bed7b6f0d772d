// From a unit as the backend names it to the quantity that people read. Pure.

import {
  figure,
  FORCE,
  LENGTH,
  NOTHING,
  PLAIN,
  PRESSURE,
  quantityOf,
  RATIO,
  SPEED,
  TIME,
  withUnit,
  type Quantity,
} from "./units";

const plain = (symbol: string, digits: number): Quantity => ({ label: "", symbol, scale: 1, digits });

const BY_UNIT: Readonly<Record<string, Quantity>> = {
  N: FORCE,
  m: LENGTH,
  "m/s": SPEED,
  Pa: PRESSURE,
  s: TIME,
  "N/s": { label: "", symbol: "kN/s", scale: 1e-3, digits: 1 },
  "m/s²": plain("m/s²", 2),
  "m/s^2": plain("m/s²", 2),
  "m³/s": { label: "", symbol: "l/min", scale: 6e4, digits: 1 },
  "m^3/s": { label: "", symbol: "l/min", scale: 6e4, digits: 1 },
  "m3/s": { label: "", symbol: "l/min", scale: 6e4, digits: 1 },
  Hz: plain("Hz", 2),
  rad: { label: "", symbol: "°", scale: 180 / Math.PI, digits: 1 },
  deg: plain("°", 1),
  dB: plain("dB", 2),
  K: plain("K", 1),
  ticks: plain("ticks", 0),
  tick: plain("ticks", 0),
  cycles: plain("cycles", 0),
  count: plain("", 0),
};
const COUNTS = new Set(["cycles", "passes", "periods", "samples", "deadlines_missed"]);

const VALVE = new Set(["valve_command", "spool_position"]);

/** The quantity of a unit; a share or a valve's opening (unit 1) is read in per cent, where its name says so. */
export function quantityOfUnit(unit: string | null | undefined, name = ""): Quantity {
  const known = COUNTS.has(name) ? BY_UNIT.count : BY_UNIT[unit ?? ""];
  if (known !== undefined) return known;
  if (unit === null || unit === undefined || unit === "" || unit === "1" || unit === "-") {
    return name.includes("share") || VALVE.has(name) ? RATIO : unit ? PLAIN : quantityOf(name);
  }
  return plain(unit, 2);
}

/** A value with its unit as people read it; small ones keep three digits that say something. */
export function inUnit(value: number | null | undefined, unit: string | null | undefined, name = ""): string {
  const quantity = quantityOfUnit(unit, name);
  return withUnit(quantity, value, extraDigits(quantity, value));
}

/** The same without its unit. */
export function inFigures(value: number | null | undefined, unit: string | null | undefined, name = ""): string {
  const quantity = quantityOfUnit(unit, name);
  return figure(quantity, value, extraDigits(quantity, value));
}

function extraDigits(quantity: Quantity, value: number | null | undefined): number {
  if (typeof value !== "number" || !Number.isFinite(value) || value === 0) return 0;
  const whole = Math.floor(Math.log10(Math.abs(value * quantity.scale)));
  if (quantity.digits === 0) return 0;
  return Math.min(2, Math.max(0, 2 - whole - quantity.digits));
}

const WORDS: Readonly<Record<string, string>> = { rms: "RMS", rmse: "RMSE", xy: "X-Y", lvt: "LVT", lvdt: "LVDT" };
const UNIT_ENDINGS = /_(n|m|s|hz|pa|deg|rad|db|m_s|n_s|m3_s|m_s2|share|n_m|percent)$/;

/** A name of the backend's as one reads it: `force_error_rms_n` is `Force error RMS`. */
export function spoken(name: string): string {
  const share = name.endsWith("_share");
  const bare = name.replace(/_(m3_s|m_s2|m_s|n_s|n_m)$/, "").replace(share ? /$^/ : UNIT_ENDINGS, "");
  const words = bare.split("_").map((word) => WORDS[word] ?? word);
  const text = words.join(" ");
  return text === "" ? NOTHING : text[0]!.toUpperCase() + text.slice(1);
}
