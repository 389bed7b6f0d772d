// How far a run has come: shares, time left, and its blocks to scale. Pure.

export interface BlockSpan {
  readonly index: number;
  readonly kind: string;
  readonly start_s: number;
  readonly duration_s: number;
}

export interface RunTimes {
  readonly elapsed_s: number;
  readonly duration_s: number | null;
  readonly block: number;
}

export interface Segment {
  readonly index: number;
  readonly kind: string;
  /** Of the whole run. */
  readonly from: number;
  readonly width: number;
  readonly state: "past" | "present" | "to come";
}

const clamped = (share: number): number => Math.min(1, Math.max(0, share));

/** Share of the run that is done; null where it has no known end. */
export const shareDone = ({ elapsed_s, duration_s }: RunTimes): number | null =>
  duration_s ? clamped(elapsed_s / duration_s) : null;

export const timeLeft_s = ({ elapsed_s, duration_s }: RunTimes): number | null =>
  duration_s === null ? null : Math.max(0, duration_s - elapsed_s);

const MOST_SEGMENTS = 400;

/** The blocks drawn to scale. Too many to be seen are none: the bar alone says more. */
export function segments(blocks: readonly BlockSpan[], times: RunTimes): readonly Segment[] {
  const { duration_s, block } = times;
  if (!duration_s || blocks.length > MOST_SEGMENTS) return [];
  return blocks.map(({ index, kind, start_s, duration_s: long_s }) => {
    const from = clamped(start_s / duration_s);
    return {
      index,
      kind,
      from,
      width: clamped((start_s + long_s) / duration_s) - from,
      state: index === block ? "present" : index < block || isPast(start_s + long_s, times) ? "past" : "to come",
    };
  });
}

const isPast = (end_s: number, { elapsed_s }: RunTimes): boolean => elapsed_s >= end_s;
