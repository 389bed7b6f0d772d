// What was, what is, and what was undone. Pure: the clock is an argument.

export interface History<T> {
  readonly past: readonly T[];
  readonly now: T;
  readonly future: readonly T[];
  /** What the last change was about: changes to the same thing in quick succession are one. */
  readonly about: string | null;
  readonly at_ms: number;
}

const DEPTH = 200;
const TOGETHER_MS = 1000;

export const begin = <T>(now: T): History<T> => ({ past: [], now, future: [], about: null, at_ms: 0 });

/** A new state; `about` null never joins the change before it. */
export function change<T>(history: History<T>, now: T, about: string | null, at_ms: number): History<T> {
  const together = about !== null && about === history.about && at_ms - history.at_ms <= TOGETHER_MS;
  const past = together ? history.past : [...history.past, history.now].slice(-DEPTH);
  return { past, now, future: [], about, at_ms };
}

/** Says more about the present state; not a step of its own. */
export const amend = <T>(history: History<T>, now: T): History<T> => ({ ...history, now });

export function undo<T>(history: History<T>): History<T> {
  const before = history.past.at(-1);
  if (before === undefined) return history;
  const future = [history.now, ...history.future];
  return { past: history.past.slice(0, -1), now: before, future, about: null, at_ms: 0 };
}

export function redo<T>(history: History<T>): History<T> {
  const [after, ...future] = history.future;
  if (after === undefined) return history;
  return { past: [...history.past, history.now], now: after, future, about: null, at_ms: 0 };
}
