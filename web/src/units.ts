// The only place in the browser that knows kN, bar, mm, per cent and local time. Everything else is SI.

const MINUS = "\u2212";
const THIN = "\u202f";
export const NOTHING = "—";

/** How one kind of quantity is shown: `shown = si × scale`, with a fixed number of digits so that figures do not jump. */
export interface Quantity {
  readonly label: string;
  readonly symbol: string;
  readonly scale: number;
  readonly digits: number;
}

export const FORCE: Quantity = { label: "Force", symbol: "kN", scale: 1e-3, digits: 2 };
export const LENGTH: Quantity = { label: "Displacement", symbol: "mm", scale: 1e3, digits: 2 };
export const SPEED: Quantity = { label: "Velocity", symbol: "mm/s", scale: 1e3, digits: 1 };
export const PRESSURE: Quantity = { label: "Pressure", symbol: "bar", scale: 1e-5, digits: 1 };
export const RATIO: Quantity = { label: "Valve", symbol: "%", scale: 100, digits: 1 };
export const TIME: Quantity = { label: "Time", symbol: "s", scale: 1, digits: 2 };
export const FORCE_RATE: Quantity = { label: "Rate", symbol: "kN/s", scale: 1e-3, digits: 1 };
export const FREQUENCY: Quantity = { label: "Frequency", symbol: "Hz", scale: 1, digits: 1 };
export const ANGLE: Quantity = { label: "Phase", symbol: "°", scale: 1, digits: 1 };
export const DECIBEL: Quantity = { label: "", symbol: "dB", scale: 1, digits: 2 };
export const PERCENT: Quantity = { label: "", symbol: "%", scale: 1, digits: 1 };
export const OCTAVES: Quantity = { label: "Sweep rate", symbol: "oct/s", scale: 1, digits: 2 };
export const PLAIN: Quantity = { label: "", symbol: "", scale: 1, digits: 2 };

const BY_SUFFIX: readonly (readonly [string, Quantity])[] = [
  ["_octaves_s", OCTAVES],
  ["_n_s", FORCE_RATE],
  ["_m_s", SPEED],
  ["_hz", FREQUENCY],
  ["_deg", ANGLE],
  ["_percent", PERCENT],
  ["_pa", PRESSURE],
  ["_n", FORCE],
  ["_m", LENGTH],
  ["_s", TIME],
];
const VALVE_UNITS = new Set([
  "valve_command",
  "spool_position",
  "compensation_velocity",
  "compensation_acceleration",
]);

/** The quantity of a channel, from the unit that ends its name. */
export function quantityOf(channel: string): Quantity {
  if (VALVE_UNITS.has(channel)) return RATIO;
  return BY_SUFFIX.find(([suffix]) => channel.endsWith(suffix))?.[1] ?? PLAIN;
}

const GAINS: Readonly<Record<string, readonly [string, number]>> = {
  "1": ["", 1],
  N: ["kN", 1e-3],
  "N s/m": ["kN s/m", 1e-3],
  "m/s": ["mm/s", 1e3],
  "m/N": ["mm/kN", 1e6],
  "N/m": ["kN/mm", 1e-6],
  "m/(N s)": ["mm/(kN s)", 1e6],
};

/** How the gain of a transfer is shown, by its unit as the backend names it. */
export function gainQuantity(unit: string): Quantity {
  const [symbol, scale] = GAINS[unit] ?? [unit, 1];
  return { label: "Gain", symbol, scale, digits: 3 };
}

/** A figure without its unit: fixed digits, true minus, no minus before zero, a dash for "not known". */
export function figure(quantity: Quantity, si: number | null | undefined, extraDigits = 0): string {
  if (si === null || si === undefined || !Number.isFinite(si)) return NOTHING;
  const digits = Math.max(0, quantity.digits + extraDigits);
  return signed((si * quantity.scale).toFixed(digits));
}

/** A figure with its unit, kept on one line: `−1.99 kN`. */
export function withUnit(quantity: Quantity, si: number | null | undefined, extraDigits = 0): string {
  const text = figure(quantity, si, extraDigits);
  return quantity.symbol === "" ? text : `${text}\u00a0${quantity.symbol}`;
}

/** A value as one types it into a field: as many digits as it has, and no more. */
export function toEntry(quantity: Quantity, si: number): string {
  return signed(String(Number((si * quantity.scale).toPrecision(12))));
}

/** What was typed into a field, in SI; null where it is no figure. A decimal comma is one; so is a true minus. */
export function fromEntry(quantity: Quantity, text: string): number | null {
  const plain = text.replace(/[\s\u00a0\u202f']/g, "").replace(MINUS, "-").replace(/^([^.,]*),([^.,]*)$/, "$1.$2");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const value = Number((Number(plain) / quantity.scale).toPrecision(12));
  return Number.isFinite(value) ? value : null;
}

/** The widest figure that a quantity shows between ± limit, in characters: for columns that stand still. */
export function figureWidth(quantity: Quantity, limitSi: number, extraDigits = 0): number {
  return figure(quantity, -Math.abs(limitSi), extraDigits).length;
}

/** Axis labels: just enough digits to tell neighbouring marks apart. */
export function axisFigures(quantity: Quantity, marksSi: readonly number[], stepSi: number): string[] {
  const step = Math.abs(stepSi * quantity.scale);
  const digits =
    step > 0 && Number.isFinite(step) ? Math.min(9, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))) : 0;
  const exact = Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) < 1e-6 ? digits : digits + 1;
  return marksSi.map((mark) => signed((mark * quantity.scale).toFixed(exact)));
}

function signed(text: string): string {
  if (!text.startsWith("-")) return text;
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : MINUS + text.slice(1);
}

/** Whole numbers with thin spaces between thousands: `81 234`. */
export function count(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NOTHING;
  const digits = String(Math.abs(Math.round(value)));
  return (value < 0 && digits !== "0" ? MINUS : "") + digits.replace(/\B(?=(\d{3})+$)/g, THIN);
}

/** A span of time as one reads it aloud: `4.4 s`, `2:05 min`, `1:02:05 h`. */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return NOTHING;
  if (seconds < 59.95) return `${Math.max(0, seconds).toFixed(1)}\u00a0s`;
  const whole = Math.round(seconds);
  const two = (value: number): string => String(value).padStart(2, "0");
  const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return hours > 0 ? `${hours}:${two(minutes)}:${two(rest)}\u00a0h` : `${minutes}:${two(rest)}\u00a0min`;
}

/** Bytes as a file manager shows them: `1.6 GB`. */
export function bytes(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NOTHING;
  const step = [1e9, 1e6, 1e3].find((unit) => value >= unit) ?? 1;
  const symbol = { 1e9: "GB", 1e6: "MB", 1e3: "kB", 1: "bytes" }[String(step)] ?? "bytes";
  const shown = value / step;
  return `${shown.toFixed(step > 1 && shown < 100 ? 1 : 0)}\u00a0${symbol}`;
}

/** Very short times of the loop, in whole microseconds: `9 µs`. */
export function microseconds(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return NOTHING;
  return `${count(seconds * 1e6)}\u00a0µs`;
}

/** A rate of ticks: `4 000 Hz`. */
export function hertz(value: number | null | undefined): string {
  return value === null || value === undefined || !Number.isFinite(value)
    ? NOTHING
    : `${count(value)}\u00a0Hz`;
}

/** A moment (ISO 8601, UTC) on the reader's own clock: `2024-11-22 14:03:09`. */
export function localTime(iso: string | null | undefined, timeZone?: string): string {
  const moment = iso ? new Date(iso) : null;
  if (!moment || Number.isNaN(moment.getTime())) return NOTHING;
  return new Intl.DateTimeFormat("sv-SE", { dateStyle: "short", timeStyle: "medium", timeZone }).format(
    moment,
  );
}
