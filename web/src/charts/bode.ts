// A frequency response as it is drawn: decibels or a unit, unwrapped phase, ranges, marks and call-outs. Pure.

import { count, gainQuantity, type Quantity } from "../units";

/** One point, as `/frequency-response` gives it; whoever has no interval leaves it out. */
export interface BodePoint {
  readonly frequency_hz: number;
  readonly gain: number;
  readonly phase_deg: number;
  readonly gain_low?: number | null;
  readonly gain_high?: number | null;
  readonly phase_low_deg?: number | null;
  readonly phase_high_deg?: number | null;
  readonly coherence?: number | null;
  /** False while its estimate still moves: drawn hollow. */
  readonly settled?: boolean;
}

/** What is called out: at which frequency, and how much in dB. */
export interface Extreme {
  readonly frequency_hz: number;
  readonly gain_db: number;
  /** What is said instead of the figures, such as a margin. */
  readonly text?: string;
}

export interface BodeSeries {
  readonly label: string;
  /** A line without marks: what is calculated, not measured. */
  readonly line?: boolean;
  readonly points: readonly BodePoint[];
  readonly extremes?: readonly Extreme[];
}

export interface BodeModel {
  readonly frequencies_hz: readonly number[];
  readonly gain: readonly number[];
  readonly phase_deg: readonly number[];
  /** The series that it is the model of: drawn in its colour. */
  readonly of?: number;
}

/** What is asked of a response in a stretch of frequencies; `null` where nothing is. */
export interface BodeBand {
  readonly from_hz: number;
  readonly to_hz: number;
  readonly low_db: number | null;
  readonly high_db: number | null;
  readonly low_deg: number | null;
  readonly high_deg: number | null;
}

export interface BodeData {
  readonly series: readonly BodeSeries[];
  readonly models: readonly BodeModel[];
  readonly bands: readonly BodeBand[];
  /** Of the gain, SI; "1" for none. */
  readonly unit: string;
  readonly decibels: boolean;
}

export type PanelName = "gain" | "phase" | "coherence";

/** What one panel draws, in the coordinates of its axis. */
export interface Dot {
  readonly hz: number;
  readonly y: number;
  readonly low: number | null;
  readonly high: number | null;
  readonly settled: boolean;
}
export interface Panel {
  readonly series: readonly (readonly Dot[])[];
  readonly models: readonly (readonly { readonly hz: number; readonly y: number }[])[];
  readonly bands: readonly { readonly from_hz: number; readonly to_hz: number; readonly low: number; readonly high: number }[];
  readonly range: Span;
}
export interface Span {
  readonly min: number;
  readonly max: number;
}

export const toDb = (gain: number): number => 20 * Math.log10(gain);
const fromDb = (db: number): number => 10 ** (db / 20);

/** Adds whole turns so that neighbours lie within half a turn; the first is brought into −270…+90°. */
export function unwrapped(degrees: readonly number[]): number[] {
  let before: number | null = null;
  return degrees.map((value) => {
    const near: number = before ?? -90;
    before = value + 360 * Math.round((near - value) / 360);
    return before;
  });
}

/** Where a gain lies on its axis: in dB, or as the logarithm of what is shown in its unit. */
function placed({ unit, decibels }: BodeData, gain: number): number {
  return decibels ? toDb(gain) : Math.log10(gain * gainQuantity(unit).scale);
}

const placedOrNull = (data: BodeData, gain: number | null | undefined): number | null =>
  typeof gain === "number" && gain > 0 ? placed(data, gain) : null;

function gains(data: BodeData, points: readonly BodePoint[]): Dot[] {
  return points.flatMap(({ frequency_hz: hz, gain, gain_low, gain_high, settled = true }) =>
    gain > 0
      ? [{ hz, y: placed(data, gain), low: placedOrNull(data, gain_low), high: placedOrNull(data, gain_high), settled }]
      : [],
  );
}

function phases(points: readonly BodePoint[]): Dot[] {
  const whole = unwrapped(points.map(({ phase_deg }) => phase_deg));
  return points.map(({ frequency_hz: hz, phase_deg, phase_low_deg, phase_high_deg, settled = true }, i) => {
    const turns = whole[i]! - phase_deg;
    return {
      ...{ hz, y: whole[i]!, settled },
      low: typeof phase_low_deg === "number" ? phase_low_deg + turns : null,
      high: typeof phase_high_deg === "number" ? phase_high_deg + turns : null,
    };
  });
}

function coherences(points: readonly BodePoint[]): Dot[] {
  return points.flatMap(({ frequency_hz: hz, coherence, settled = true }) =>
    typeof coherence === "number" ? [{ hz, y: coherence, low: null, high: null, settled }] : [],
  );
}

/** Whether nothing came out: without a gain a phase is chance. */
const stoodStill = ({ gain }: BodePoint): boolean => gain === 0;

/** Whether there are points, and in none of them the output moved. */
export function allStoodStill(series: readonly BodeSeries[]): boolean {
  const all = series.flatMap(({ points }) => points);
  return all.length > 0 && all.every(stoodStill);
}

/** The points of all series in order of frequency, as one panel shows them. */
export function panelOf(name: PanelName, data: BodeData): Panel {
  const ordered = data.series.map(({ points }) =>
    points.filter((one) => !stoodStill(one)).sort((a, b) => a.frequency_hz - b.frequency_hz),
  );
  if (name === "coherence") {
    const series = ordered.map(coherences);
    return { series, models: [], bands: [], range: coherenceRange(series.flat()) };
  }
  const series = ordered.map((points) => (name === "gain" ? gains(data, points) : phases(points)));
  const models = data.models.map((model) => {
    const phase = unwrapped(model.phase_deg);
    return model.frequencies_hz.flatMap((hz, i) => {
      const y = name === "gain" ? placedOrNull(data, model.gain[i]) : phase[i]!;
      return y === null ? [] : [{ hz, y }];
    });
  });
  const bands = data.bands.flatMap((band) => bandOf(name, data, band));
  const edges = bands.flatMap(({ low, high }) => [low, high]).filter(Number.isFinite);
  const drawn = [...series.flat(), ...models.flat()].map(({ y }) => y);
  return { series, models, bands, range: spanOf([...drawn, ...edges], name === "gain" ? leastSpan(data) : 20) };
}

const leastSpan = ({ decibels }: BodeData): number => (decibels ? 2 : 0.1);

function bandOf(name: PanelName, data: BodeData, band: BodeBand): Panel["bands"] {
  const { from_hz, to_hz } = band;
  const at = (db: number): number => placed(data, fromDb(db));
  const [low, high] =
    name === "phase"
      ? [band.low_deg, band.high_deg]
      : [band.low_db === null ? null : at(band.low_db), band.high_db === null ? null : at(band.high_db)];
  return low === null && high === null ? [] : [{ from_hz, to_hz, low: low ?? -Infinity, high: high ?? Infinity }];
}

/** Around all values with a margin, and at least so wide. Nothing to show: around zero. */
export function spanOf(values: readonly number[], least: number): Span {
  const finite = values.filter(Number.isFinite);
  const low = finite.length > 0 ? Math.min(...finite) : 0;
  const high = finite.length > 0 ? Math.max(...finite) : 0;
  const half = Math.max((high - low) * 0.58, least / 2);
  return { min: (low + high) / 2 - half, max: (low + high) / 2 + half };
}

const FLOORS = [0.99, 0.98, 0.95, 0.9, 0.8, 0.5, 0] as const;

/** Up to one, and down as far as it must: a coherence of 0.98 and one of 0.99 are to be told apart. */
function coherenceRange(dots: readonly Dot[]): Span {
  const least = Math.min(1, ...dots.map(({ y }) => y));
  const min = FLOORS.find((floor) => floor <= least - 0.001) ?? 0;
  return { min: min - 0.15 * (1 - min), max: 1 + 0.35 * (1 - min) };
}

/** The frequencies of everything that is drawn, a little wider; of nothing, 1…100 Hz. */
export function frequencyRange({ series, models, bands }: BodeData): Span {
  const measured = series.flatMap(({ points }) => points.map(({ frequency_hz }) => frequency_hz));
  let all = [...measured, ...models.flatMap(({ frequencies_hz }) => frequencies_hz)];
  if (all.length === 0) all = bands.flatMap(({ from_hz, to_hz }) => [from_hz, to_hz]);
  const positive = all.filter((hz) => hz > 0);
  if (positive.length === 0) return { min: 1, max: 100 };
  const [low, high] = [Math.min(...positive), Math.max(...positive)];
  const margin = low === high ? 2 : Math.max(1.05, (high / low) ** 0.03);
  return { min: low / margin, max: high * margin };
}

/** All frequencies that have a point, each once, in order: where the cursor can be. */
export function frequencies(series: readonly BodeSeries[]): readonly number[] {
  const all = series.flatMap(({ points }) => points.map(({ frequency_hz }) => frequency_hz));
  return [...new Set(all)].sort((a, b) => a - b);
}

/** The frequency nearest to one, as the eye sees it on a logarithmic axis; null where there is none. */
export function nearest(all: readonly number[], hz: number): number | null {
  const away = (other: number): number => Math.abs(Math.log(other / hz));
  return all.reduce<number | null>((best, next) => (best === null || away(next) < away(best) ? next : best), null);
}

/** The point of a series at a frequency. */
export const pointAt = ({ points }: BodeSeries, hz: number | null): BodePoint | null =>
  points.find(({ frequency_hz }) => frequency_hz === hz) ?? null;

const MINUS = "\u2212";
const plus = (value: number, digits: number): string => {
  const text = Math.abs(value).toFixed(digits);
  return Number(text) === 0 ? text : `${value < 0 ? MINUS : "+"}${text}`;
};

/** `+3.6 dB`, `−2.0 dB`. */
export const decibels = (db: number, digits = 1): string => `${plus(db, digits)}\u00a0dB`;

/** `35 Hz`, `2.5 Hz`: three figures at most. */
export function frequencyText(hz: number): string {
  const digits = hz < 10 ? 2 : hz < 100 ? 1 : 0;
  const text = hz >= 1000 ? count(hz) : String(Number(hz.toFixed(digits)));
  return `${text}\u00a0Hz`;
}

/** `+3.6 dB at 35 Hz`. */
export const extremeText = ({ frequency_hz, gain_db, text }: Extreme): string =>
  text ?? `${decibels(gain_db)} at ${frequencyText(frequency_hz)}`;

/** A gain as the cursor reads it: in dB, or in its unit with four figures. */
export function gainText(data: Pick<BodeData, "unit" | "decibels">, gain: number): string {
  if (data.decibels) return decibels(toDb(gain), 2);
  const quantity: Quantity = gainQuantity(data.unit);
  const figure = Number((gain * quantity.scale).toPrecision(4));
  return quantity.symbol === "" ? String(figure) : `${figure}\u00a0${quantity.symbol}`;
}

export const phaseText = (degrees: number): string => `${plus(degrees, 1).replace("+", "")}°`;
