// A y range that a person can read while data move: it grows at once, and shrinks only when the data have been
// small for a while. Pure: the clock is an argument.

export interface ScaleOptions {
  /** Keep zero in the middle. */
  readonly centred: boolean;
  /** The range is never narrower than this, in SI. */
  readonly minSpan: number;
}

export interface SteadyRange {
  readonly min: number;
  readonly max: number;
  readonly looseSince_s: number | null;
}

const SHRINK_BELOW = 0.6;
const SHRINK_AFTER_S = 3;
const MARGIN = 0.06;
const ROUND = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10] as const;

/** The range for data within [low, high] at `now_s`; NaN (no data) changes nothing. */
export function steadyRange(
  previous: SteadyRange | null,
  low: number,
  high: number,
  now_s: number,
  options: ScaleOptions,
): SteadyRange {
  if (!(low <= high)) return previous ?? { ...wanted(0, 0, options), looseSince_s: null };
  const target = wanted(low, high, options);
  if (previous === null) return { ...target, looseSince_s: null };
  if (low < previous.min || high > previous.max) {
    const grown = wanted(Math.min(low, previous.min), Math.max(high, previous.max), options, 0);
    const covers = target.min <= previous.min && target.max >= previous.max;
    return { ...(covers ? target : grown), looseSince_s: null };
  }
  if (target.max - target.min > SHRINK_BELOW * (previous.max - previous.min)) return settled(previous);
  const since = previous.looseSince_s ?? now_s;
  return now_s - since >= SHRINK_AFTER_S
    ? { ...target, looseSince_s: null }
    : { ...previous, looseSince_s: since };
}

function settled(range: SteadyRange): SteadyRange {
  return range.looseSince_s === null ? range : { ...range, looseSince_s: null };
}

function wanted(
  low: number,
  high: number,
  { centred, minSpan }: ScaleOptions,
  margin = MARGIN,
): { min: number; max: number } {
  if (centred) {
    const reach = roundUp(Math.max(Math.abs(low), Math.abs(high), minSpan / 2 / (1 + margin)) * (1 + margin));
    return { min: -reach, max: reach };
  }
  const span = Math.max(high - low, minSpan / (1 + 2 * margin));
  const middle = (low + high) / 2;
  const step = roundUp((span * (1 + 2 * margin)) / 8);
  const min = Math.floor((middle - span * (0.5 + margin)) / step + 1e-9) * step;
  const max = Math.ceil((middle + span * (0.5 + margin)) / step - 1e-9) * step;
  return { min, max };
}

/** The next round number upwards: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten. */
export function roundUp(value: number): number {
  const decade = 10 ** Math.floor(Math.log10(value));
  return (ROUND.find((round) => round * decade >= value * (1 - 1e-9)) ?? 10) * decade;
}
