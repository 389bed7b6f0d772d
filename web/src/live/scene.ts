// Where the cursor of a run's charts stands, for a 3-D view beside them to follow.

type Listener = (time_s: number | null) => void;

const listeners = new Set<Listener>();
let last: number | null = null;

/** The cursor stands at a time (s from the run's first tick); null: it is not on a chart. */
export function pointAt(time_s: number | null): void {
  if (time_s === last) return;
  last = time_s;
  for (const listener of listeners) listener(time_s);
}

/** Calls back whenever it moves. @returns a function that ends it. */
export function followCursor(listener: Listener): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}
