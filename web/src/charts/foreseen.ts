// What was predicted, drawn under what was measured: a band in grey, dashed at its edges.

import type uPlot from "uplot";
import type { BandTrace } from "./bandPlot";
import { colour } from "./colours";

export function drawForeseen(plot: uPlot, { time_s, min, max }: BandTrace): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.strokeStyle = colour("--stale");
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.setLineDash([5 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const edge of min.every((value, i) => value === max[i]) ? [min] : [min, max]) trace(plot, time_s, edge);
  ctx.restore();
}

function trace(plot: uPlot, time_s: readonly number[], values: readonly (number | null)[]): void {
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
