// Looking closer at a recorded run, and back. Pure: a stack of time windows in seconds.

export interface TimeWindow {
  readonly from_s: number;
  readonly to_s: number;
}

/** The windows one has zoomed through, the whole run first, the one that is shown last. Never empty. */
export type ZoomStack = readonly TimeWindow[];

const DEPTH = 50;
const LEAST_TICKS = 10;

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

/** Moves the window by a share of its width, without a new step in the stack. */
export function pan(stack: ZoomStack, share: number): ZoomStack {
  const { from_s, to_s } = shownWindow(stack);
  const by = share * (to_s - from_s);
  if (stack.length === 1) return stack;
  return [...stack.slice(0, -1), inside({ from_s: from_s + by, to_s: to_s + by }, stack[0]!, 0)];
}

/** What a key does to the window; null where it does nothing. */
export function byKey(stack: ZoomStack, key: string, period_s: number): ZoomStack | null {
  if (key === "+" || key === "=") return closer(stack, period_s);
  if (key === "-") return zoomOut(stack);
  if (key === "0") return stack.slice(0, 1);
  if (key === "ArrowLeft") return pan(stack, -0.25);
  if (key === "ArrowRight") return pan(stack, 0.25);
  return null;
}

function inside(wanted: TimeWindow, limits: TimeWindow, least_s: number): TimeWindow {
  const width = Math.min(Math.max(wanted.to_s - wanted.from_s, least_s), limits.to_s - limits.from_s);
  const middle = (wanted.from_s + wanted.to_s) / 2;
  const from_s = Math.min(Math.max(middle - width / 2, limits.from_s), limits.to_s - width);
  return { from_s, to_s: from_s + width };
}
