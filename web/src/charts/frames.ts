// One requestAnimationFrame loop for everything that is drawn, so that all charts show the same moment.

type Draw = (now_ms: number) => void;

const drawers = new Set<Draw>();
let handle: number | null = null;

function frame(now_ms: number): void {
  for (const draw of drawers) draw(now_ms);
  handle = drawers.size > 0 ? requestAnimationFrame(frame) : null;
}

/** Calls `draw` before every repaint. @returns a function that ends it. */
export function onFrame(draw: Draw): () => void {
  drawers.add(draw);
  handle ??= requestAnimationFrame(frame);
  return () => drawers.delete(draw);
}
