// Margins to the detectors as bars: how much of each limit the prediction uses. Pure.

import { inUnit, spoken } from "../../quantities";
import { duration, NOTHING } from "../../units";
import type { Margin } from "../../live/types";

export type Nearness = "within" | "near" | "beyond";

export interface MarginRow {
  readonly name: string;
  /** Share of the limit that is used, 0…1 of the bar; null where nothing is known. */
  readonly used: number | null;
  readonly nearness: Nearness;
  /** `33.1 kN of 50.0 kN` */
  readonly extreme: string;
  readonly share: string;
  /** `at 2.31 s, block 3` */
  readonly when: string;
  readonly action: string;
  /** Predicted, and armed at all. */
  readonly known: boolean;
}

/** Below this share of its limit a margin is small. The backend judges a caution; this only colours. */
const SMALL = 0.1;

const used = (margin: Margin): number | null => (margin.margin_share === null ? null : 1 - margin.margin_share);

/** The smallest margin on top, those that cannot be predicted at the end. */
export function marginRows(margins: readonly Margin[]): readonly MarginRow[] {
  const key = (margin: Margin): number => (margin.predicted ? (margin.margin_share ?? 1e8) : 1e9);
  return [...margins].sort((a, b) => key(a) - key(b)).map(rowOf);
}

function rowOf(margin: Margin): MarginRow {
  const share = used(margin);
  const { extreme, threshold, unit, quantity, margin_share, predicted, note } = margin;
  const known = predicted && extreme !== null;
  return {
    name: spoken(margin.detector),
    used: known && share !== null ? Math.min(1, Math.max(0, share)) : null,
    nearness: !known || margin_share === null ? "within" : nearnessOf(margin_share),
    extreme: known ? `${inUnit(extreme, unit, quantity)} of ${inUnit(threshold, unit, quantity)}` : (note ?? ""),
    share: known && margin_share !== null ? perCent(margin_share) : NOTHING,
    when: known ? whenOf(margin) : "",
    action: margin.action,
    known,
  };
}

function nearnessOf(margin_share: number): Nearness {
  return margin_share <= 0 ? "beyond" : margin_share < SMALL ? "near" : "within";
}

const perCent = (share: number): string => `${Math.round(100 * share)}\u00a0%`.replace("-", "\u2212");

function whenOf({ time_s, block }: Margin): string {
  const at = time_s === null ? "" : `at ${duration(time_s)}`;
  const inBlock = block === null || block < 0 ? "" : `block ${block + 1}`;
  return [at, inBlock].filter(Boolean).join(", ");
}
