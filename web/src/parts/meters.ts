// Geometry of a meter's bar. Pure: everything in shares of the bar's width, 0 left to 1 right.

import type { Span } from "../live/samples";

export interface MeterScale {
  readonly low: number;
  readonly high: number;
}

export interface MeterShape {
  /** From zero (or the left end) to the value. */
  readonly bar: readonly [number, number];
  /** Extremes of the last second, null where not known. */
  readonly band: readonly [number, number] | null;
  readonly commanded: number | null;
  readonly zero: number;
}

const share = (value: number, { low, high }: MeterScale): number =>
  Math.min(1, Math.max(0, (value - low) / (high - low)));

export function meterShape(
  value: number | null | undefined,
  span: Span | undefined,
  commanded: number | null | undefined,
  scale: MeterScale,
): MeterShape {
  const zero = share(0, scale);
  const at = isKnown(value) ? share(value, scale) : zero;
  return {
    zero,
    bar: [Math.min(zero, at), Math.max(zero, at)],
    band:
      span && isKnown(span.low) && isKnown(span.high)
        ? [share(span.low, scale), share(span.high, scale)]
        : null,
    commanded: isKnown(commanded) ? share(commanded, scale) : null,
  };
}

export type Nearness = "within" | "near" | "beyond";
const NEAR = 0.9;

/** How near the last second came to a limit that holds in both directions; no limit is never near. */
export function nearness(
  value: number | null | undefined,
  span: Span | undefined,
  limit: number | null | undefined,
): Nearness {
  if (!isKnown(limit) || limit <= 0) return "within";
  const reached = Math.max(...[value, span?.low, span?.high].filter(isKnown).map(Math.abs), 0);
  return reached >= limit ? "beyond" : reached >= NEAR * limit ? "near" : "within";
}

function isKnown(value: number | null | undefined): value is number {
  return typeof value === "number" && Number.isFinite(value);
}
