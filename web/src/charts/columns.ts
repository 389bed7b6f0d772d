// Drawing of decimated columns: one upright bar a column, as an oscilloscope does. A stroked zigzag of a thousand
// long edges shows the same and costs a browser without a graphics card ten times as much.

import type uPlot from "uplot";

/** One bar in canvas pixels. */
export interface Bar {
  x: number;
  y: number;
  width: number;
  height: number;
}

type Position = (value: number) => number;

/**
 * Calls `draw` with the bar of each column. Columns are pairs in time order, as `Trace` makes them: a bar spans both
 * extremes and reaches back to where the column before ended, so that a line has no breaks. A column without samples
 * leaves a gap. The one `Bar` is used again for every call.
 */
export function eachBar(
  x: readonly number[],
  y: readonly (number | null)[],
  xAt: Position,
  yAt: Position,
  thickness: number,
  draw: (bar: Bar) => void,
): void {
  const bar: Bar = { x: 0, y: 0, width: 0, height: 0 };
  const half = thickness / 2;
  let before: number | null = null;
  let right = NaN;
  for (let i = 0; i + 1 < x.length; i += 2) {
    const [first, second] = [y[i], y[i + 1]];
    const width = x[i + 1]! - x[i]!;
    const left = Number.isNaN(right) ? Math.round(xAt(x[i]! - width / 2)) : right;
    right = Math.round(xAt(x[i + 1]! + width / 2));
    if (first === null || first === undefined || second === null || second === undefined) {
      before = null;
      continue;
    }
    const [a, b] = [yAt(first), yAt(second)];
    const c: number = before ?? a;
    bar.x = left;
    bar.width = Math.max(1, right - left);
    bar.y = Math.min(a, b, c) - half;
    bar.height = Math.max(a, b, c) + half - bar.y;
    before = b;
    draw(bar);
  }
}

/** Draws one decimated series of a plot; uPlot itself draws nothing for it. */
export function drawBars(plot: uPlot, series: number): void {
  const { stroke, width } = plot.series[series]!;
  const { ctx, bbox } = plot;
  const [x, y] = [plot.data[0] as number[], plot.data[series] as (number | null)[]];
  const thickness = Math.max(1, (width ?? 1) * devicePixelRatio);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = (stroke as (u: uPlot, i: number) => string)(plot, series);
  const [xAt, yAt] = [linear(plot, "x"), linear(plot, "y")];
  eachBar(x, y, xAt, yAt, thickness, (bar) => ctx.fillRect(bar.x, bar.y, bar.width, bar.height));
  ctx.restore();
}

/** `valToPos` of a linear scale, worked out once a frame and not once a value. */
function linear(plot: uPlot, scale: string): Position {
  const { min, max } = plot.scales[scale]!;
  const [from, to] = [plot.valToPos(min!, scale, true), plot.valToPos(max!, scale, true)];
  const slope = (to - from) / (max! - min!);
  return (value) => from + (value - min!) * slope;
}
