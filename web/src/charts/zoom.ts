// Looking closer at a recorded run, and back. Pure: a stack of time windows in seconds.

export interface TimeWindow {
  readonly from_s: number;
  readonly to_s: number;
}

/** The windows one has zoomed through, the whole run first, the one that is shown last. Never empty. */
export type ZoomStack = readonly TimeWindow[];

const DEPTH = 50;
const LEAST_TICKS = 10;
/** What is seen around an event that one jumps to, s. */
const NEAR_S = 2;

export const whole = (duration_s: number): ZoomStack => [{ from_s: 0, to_s: duration_s }];
export const shownWindow = (stack: ZoomStack): TimeWindow => stack.at(-1)!;

/** Zooms to a window, kept inside the run and not narrower than a few ticks. */
export function zoomTo(stack: ZoomStack, wanted: TimeWindow, period_s: number): ZoomStack {
  if (!(wanted.from_s < wanted.to_s)) return stack;
  const next = inside(wanted, stack[0]!, LEAST_TICKS * period_s);
  const now = shownWindow(stack);
  if (next.from_s === now.from_s && next.to_s === now.to_s) return stack;
  return [...stack.slice(0, DEPTH - 1), next];
}

/** Back to the window before. */
export const zoomOut = (stack: ZoomStack): ZoomStack => (stack.length > 1 ? stack.slice(0, -1) : stack);

/** Half the window around its middle. */
export function closer(stack: ZoomStack, period_s: number): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  const quarter = (to_s - from_s) / 4;
  return zoomTo(stack, { from_s: from_s + quarter, to_s: to_s - quarter }, period_s);
}

/** Double the window around its middle; the whole run at last. */
export function farther(stack: ZoomStack): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  return widened(stack, { from_s: from_s - (to_s - from_s) / 2, to_s: to_s + (to_s - from_s) / 2 });
}

/**
 * Zooms by a factor around a moment, which stays where it is on the screen: below 1 closer, above 1 farther.
 * @param again part of the same gesture: it takes the place of the step before, so that one step leads back.
 */
export function zoomAt(
  stack: ZoomStack,
  at_s: number,
  factor: number,
  period_s: number,
  again: boolean,
): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  const [run] = stack as [TimeWindow];
  const least_s = Math.min(LEAST_TICKS * period_s, run.to_s - run.from_s);
  const width = Math.max(least_s, factor * (to_s - from_s));
  const share = (at_s - from_s) / (to_s - from_s);
  if (!Number.isFinite(width + share)) return stack;
  const left = Math.min(Math.max(at_s - share * width, run.from_s), run.to_s - Math.min(width, run.to_s - run.from_s));
  const wanted = { from_s: left, to_s: left + width };
  if (width >= to_s - from_s) return widened(stack, wanted);
  const base = again && stack.length > 1 ? stack.slice(0, -1) : stack.slice(0, DEPTH - 1);
  return [...base, inside(wanted, run, 0)];
}

/** Shows a moment in the middle; the window keeps its width where that is a look from near, else becomes one. */
export function jumpTo(stack: ZoomStack, at_s: number, period_s: number): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  const [run] = stack as [TimeWindow];
  const near_s = Math.max(LEAST_TICKS * period_s, Math.min(NEAR_S, run.to_s - run.from_s));
  const half = (stack.length > 1 ? Math.min(to_s - from_s, near_s) : near_s) / 2;
  return zoomTo(stack, { from_s: at_s - half, to_s: at_s + half }, period_s);
}

/** The same window in a run that has grown; whoever looks at the whole of it goes on doing so. */
export const grown = (stack: ZoomStack, duration_s: number): ZoomStack => [
  { from_s: 0, to_s: Math.max(duration_s, stack[0]!.to_s) },
  ...stack.slice(1),
];

function widened(stack: ZoomStack, wanted: TimeWindow): ZoomStack {
  const [run] = stack as [TimeWindow];
  const next = inside(wanted, run, 0);
  const isWhole = next.to_s - next.from_s >= (run.to_s - run.from_s) * (1 - 1e-9);
  return isWhole ? [run] : [...stack.slice(0, -1), next];
}

/** Moves the window by a share of its width, without a new step in the stack. */
export function pan(stack: ZoomStack, share: number): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  if (stack.length === 1) return stack;
  const [run] = stack as [TimeWindow];
  const by = Math.min(run.to_s - to_s, Math.max(run.from_s - from_s, share * (to_s - from_s)));
  return [...stack.slice(0, -1), inside({ from_s: from_s + by, to_s: to_s + by }, stack[0]!, 0)];
}

/** What a key does to the window; null where it does nothing. */
export function byKey(stack: ZoomStack, key: string, period_s: number, shift = false): ZoomStack | null {
  if (key === "+" || key === "=") return closer(stack, period_s);
  if (key === "-") return farther(stack);
  if (key === "0") return stack.slice(0, 1);
  if (key === "ArrowLeft") return pan(stack, shift ? -1 : -0.25);
  if (key === "ArrowRight") return pan(stack, shift ? 1 : 0.25);
  if (key === "Home") return pan(stack, -Infinity);
  if (key === "End") return pan(stack, Infinity);
  return null;
}

function inside(wanted: TimeWindow, limits: TimeWindow, least_s: number): TimeWindow {
  const width = Math.min(Math.max(wanted.to_s - wanted.from_s, least_s), limits.to_s - limits.from_s);
  const middle = (wanted.from_s + wanted.to_s) / 2;
  const from_s = Math.min(Math.max(middle - width / 2, limits.from_s), limits.to_s - width);
  return { from_s, to_s: from_s + width };
}

const PLACES = 7; // a tick of 4 kHz is 0.00025 s; more would be noise in the address

/** A window as it stands in the address; null where it stands for none of this recording. */
export function windowOf(query: URLSearchParams, all: TimeWindow): TimeWindow | null {
  const [from_s, to_s] = [Number(query.get("from") ?? NaN), Number(query.get("to") ?? NaN)];
  if (!(from_s < to_s) || from_s < all.from_s || from_s >= all.to_s) return null;
  return { from_s, to_s: Math.min(to_s, all.to_s) };
}

/** Writes the window into the address; the whole run needs no words. */
export function writeWindow(query: URLSearchParams, stack: ZoomStack): void {
  const { from_s, to_s } = shownWindow(stack);
  query.delete("from");
  query.delete("to");
  if (stack.length === 1) return;
  query.set("from", String(Number(from_s.toFixed(PLACES))));
  query.set("to", String(Number(to_s.toFixed(PLACES))));
}
