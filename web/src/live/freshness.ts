// Whether what is on the screen may still be believed. Pure: the clock is an argument.

export const STALE_AFTER_S = 1;

export interface Signs {
  readonly socketOpen: boolean;
  /** Local monotonic times of the last arrivals, null before the first. */
  readonly statusAt_s: number | null;
  readonly samplesAt_s: number | null;
  /** From the last status. */
  readonly loopAlive: boolean | null;
  readonly loopAge_s: number | null;
  /** The loop process was started and has not yet given a sign of life. */
  readonly loopStarting: boolean;
}

export type Trouble = "connecting" | "link" | "starting" | "loop" | "samples" | null;

export interface Freshness {
  readonly stale: boolean;
  readonly trouble: Trouble;
  /** How old the newest data on the screen are; null where none ever came. */
  readonly age_s: number | null;
}

/** Judges the signs of life at local time `now_s`. The link is judged before the loop: a dead link knows nothing of it. */
export function judge(signs: Signs, now_s: number): Freshness {
  if (signs.statusAt_s === null) return { stale: true, trouble: "connecting", age_s: null };
  const sinceStatus = now_s - signs.statusAt_s;
  const loopAge = (signs.loopAge_s ?? 0) + sinceStatus;
  if (!signs.socketOpen || sinceStatus > STALE_AFTER_S)
    return { stale: true, trouble: "link", age_s: loopAge };
  if (signs.loopStarting) return { stale: true, trouble: "starting", age_s: null };
  if (!signs.loopAlive || loopAge > STALE_AFTER_S) return { stale: true, trouble: "loop", age_s: loopAge };
  const sinceSamples = signs.samplesAt_s === null ? sinceStatus : now_s - signs.samplesAt_s;
  if (sinceSamples > STALE_AFTER_S) return { stale: true, trouble: "samples", age_s: sinceSamples };
  return { stale: false, trouble: null, age_s: Math.max(loopAge, sinceSamples) };
}

const WORDS: Record<Exclude<Trouble, null>, string> = {
  connecting: "connecting to the server",
  link: "link to the server lost",
  starting: "the loop process is starting",
  loop: "loop process lost",
  samples: "the server sends no samples",
};

/** The sentence of the banner: `No data for 3 s: link to the server lost`. Empty while the data are fresh. */
export function sentence({ trouble, age_s }: Freshness): string {
  if (trouble === null) return "";
  if (age_s === null) return `No data yet: ${WORDS[trouble]}`;
  return `No data for ${age(age_s)}: ${WORDS[trouble]}`;
}

function age(age_s: number): string {
  if (age_s < 120) return `${Math.max(1, Math.floor(age_s))} s`;
  if (age_s < 7200) return `${Math.floor(age_s / 60)} min`;
  return `${Math.floor(age_s / 3600)} h`;
}
