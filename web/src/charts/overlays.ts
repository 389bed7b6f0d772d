// What else is drawn under what was measured: what was predicted, what would have happened, and limits.

import type uPlot from "uplot";
import type { BandTrace } from "./bandPlot";
import { colour } from "./colours";

/** A band, or a line where both its edges are the same. */
export interface Overlay {
  readonly trace: BandTrace;
  readonly label: string;
  /** A CSS variable. */
  readonly colour: string;
  readonly dashed: boolean;
}

export const predicted = (trace: BandTrace): Overlay => ({
  trace,
  label: "Predicted",
  colour: "--stale",
  dashed: true,
});

/** Lowest and highest value of the overlays within a window, infinite where there is none. */
export function overlayExtent(
  overlays: readonly Overlay[],
  { from_s, to_s }: { readonly from_s: number; readonly to_s: number },
): { low: number; high: number } {
  const extent = { low: Infinity, high: -Infinity };
  for (const { trace } of overlays)
    trace.time_s.forEach((time, i) => {
      if (time < from_s || time > to_s) return;
      extent.low = Math.min(extent.low, trace.min[i] ?? Infinity);
      extent.high = Math.max(extent.high, trace.max[i] ?? -Infinity);
    });
  return extent;
}

const NEAR = 1.6;

/** The limits that are near enough to be shown with the data: more would make the data small. */
export function limitsNear(limits: readonly number[], low: number, high: number): readonly number[] {
  const span = high - low;
  return limits.filter((limit) => Math.max(high, limit) - Math.min(low, limit) <= NEAR * span);
}

export function drawOverlay(plot: uPlot, { trace, colour: variable, dashed }: Overlay): void {
  const { time_s, min, max } = trace;
  inside(plot, variable, dashed ? [5, 3] : [], 1.5, () => {
    for (const edge of min.every((value, i) => value === max[i]) ? [min] : [min, max]) follow(plot, time_s, edge);
  });
}

/** Limits as lines across the plot. */
export function drawLimits(plot: uPlot, limits: readonly number[]): void {
  const { left, width } = plot.bbox;
  inside(plot, "--trip", [2, 3], 1.5, () => {
    for (const limit of limits) {
      const y = Math.round(plot.valToPos(limit, "y", true));
      plot.ctx.beginPath();
      plot.ctx.moveTo(left, y);
      plot.ctx.lineTo(left + width, y);
      plot.ctx.stroke();
    }
  });
}

function inside(plot: uPlot, variable: string, dash: readonly number[], width: number, draw: () => void): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.strokeStyle = colour(variable);
  ctx.lineWidth = width * devicePixelRatio;
  ctx.setLineDash(dash.map((length) => length * devicePixelRatio));
  draw();
  ctx.restore();
}

function follow(plot: uPlot, time_s: readonly number[], values: readonly (number | null)[]): void {
  plot.ctx.beginPath();
  let drawing = false;
  values.forEach((value, i) => {
    if (value === null) return void (drawing = false);
    const x = plot.valToPos(time_s[i]!, "x", true);
    const y = plot.valToPos(value, "y", true);
    if (drawing) plot.ctx.lineTo(x, y);
    else plot.ctx.moveTo(x, y);
    drawing = true;
  });
  plot.ctx.stroke();
}
