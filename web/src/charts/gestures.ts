// Wheel, fingers and shifted drags on a chart of a run, as zooming around a moment and moving along.

export interface Gestures {
  /** Zoom around a place, in pixels from the left of the plot; `again`: the same gesture goes on. */
  zoom(at_px: number, factor: number, again: boolean): void;
  /** Move by pixels: what is under the pointer goes with it. */
  move(by_px: number): void;
}

const SAME_GESTURE_MS = 400;
const PER_LINE_PX = 16;
const SPEED = 0.0022;

/** The factor of a turn of the wheel: a notch (100 px) is a quarter, a trackpad gives small steps. */
export const wheelFactor = (delta: number, lines: boolean): number =>
  Math.exp(Math.max(-1, Math.min(1, delta * (lines ? PER_LINE_PX : 1) * SPEED)));

/** Listens on the plot's area. @returns a function that ends it. */
export function listen(over: HTMLElement, to: Gestures): () => void {
  let lastWheel = -Infinity;
  const fingers = new Map<number, number>();
  let moved = -1;

  function onWheel(event: WheelEvent): void {
    if (event.ctrlKey && event.deltaY === 0) return;
    event.preventDefault();
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) return to.move(-sideways);
    const at = event.clientX - over.getBoundingClientRect().left;
    to.zoom(at, wheelFactor(event.deltaY, event.deltaMode === 1), event.timeStamp - lastWheel < SAME_GESTURE_MS);
    lastWheel = event.timeStamp;
  }

  const isMove = (event: PointerEvent): boolean =>
    event.pointerType === "touch" || event.button === 1 || (event.button === 0 && event.shiftKey);

  function onDown(event: PointerEvent): void {
    if (!isMove(event)) return;
    event.preventDefault();
    fingers.set(event.pointerId, event.clientX);
    over.setPointerCapture(event.pointerId);
    moved = 0;
  }

  function onMove(event: PointerEvent): void {
    const before = fingers.get(event.pointerId);
    if (before === undefined) return;
    if (fingers.size === 1) to.move(event.clientX - before);
    else pinch(event.pointerId, before, event.clientX);
    fingers.set(event.pointerId, event.clientX);
    moved += 1;
  }

  function pinch(id: number, before: number, now: number): void {
    const other = [...fingers].find(([finger]) => finger !== id)?.[1] ?? now;
    const [was, is] = [Math.max(8, Math.abs(before - other)), Math.max(8, Math.abs(now - other))];
    to.zoom((now + other) / 2 - over.getBoundingClientRect().left, was / is, moved > 0);
  }

  function onUp(event: PointerEvent): void {
    fingers.delete(event.pointerId);
  }

  /** A shifted drag moves; it must not become uPlot's selection. */
  function onMouseDown(event: MouseEvent): void {
    if (event.shiftKey || event.button === 1) event.stopImmediatePropagation();
  }

  const capture = { capture: true };
  over.style.touchAction = "pan-y";
  over.addEventListener("wheel", onWheel, { passive: false });
  over.addEventListener("pointerdown", onDown);
  over.addEventListener("pointermove", onMove);
  over.addEventListener("pointerup", onUp);
  over.addEventListener("pointercancel", onUp);
  over.parentElement?.addEventListener("mousedown", onMouseDown, capture);
  return () => over.parentElement?.removeEventListener("mousedown", onMouseDown, capture);
}
