// What one panel of a frequency response is made of, on canvas: bands, models, series with their intervals, call-outs.

import type uPlot from "uplot";
import type { BodeModel, BodeSeries, Dot, Panel } from "./bode";
import { place } from "./callouts";
import { colour } from "./colours";
import { fontSize } from "./options";
import { outline, seriesColour, shapeOf } from "./seriesLook";

/** A point that is called by its name. */
export interface Named {
  readonly hz: number;
  readonly y: number;
  readonly text: string;
  readonly above: boolean;
  readonly series: number;
}

/** Points nearer than this are a band with a line, others have bars. */
const APART_PX = 9;
const RADIUS_PX = 3;

interface Places {
  readonly x: (hz: number) => number;
  readonly y: (value: number) => number;
}

/** Draws within the panel, in canvas pixels. */
function within(plot: uPlot, draw: (ctx: CanvasRenderingContext2D, places: Places) => void): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  draw(ctx, { x: (hz) => plot.valToPos(hz, "x", true), y: (value) => plot.valToPos(value, "y", true) });
  ctx.restore();
}

/** What is asked for: the room between its edges, tinted, with the edges as lines. */
export function drawBands(plot: uPlot, { bands, range }: Panel): void {
  within(plot, (ctx, { x, y }) => {
    ctx.strokeStyle = ctx.fillStyle = colour("--setpoint");
    ctx.lineWidth = devicePixelRatio;
    for (const { from_hz, to_hz, low, high } of bands) {
      const [left, right] = [x(from_hz), x(to_hz)];
      const [top, bottom] = [y(Math.min(high, range.max)), y(Math.max(low, range.min))];
      ctx.globalAlpha = 0.13;
      ctx.fillRect(left, top, right - left, bottom - top);
      ctx.globalAlpha = 0.8;
      ctx.beginPath();
      for (const edge of [low, high].filter(Number.isFinite)) {
        ctx.moveTo(left, y(edge));
        ctx.lineTo(right, y(edge));
      }
      ctx.stroke();
    }
  });
}

export function drawModels(plot: uPlot, { models }: Panel, of: readonly BodeModel[]): void {
  within(plot, (ctx, { x, y }) => {
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
    models.forEach((curve, i) => {
      const series = of[i]?.of;
      ctx.strokeStyle = colour(series === undefined ? "--ink-2" : seriesColour(series));
      ctx.globalAlpha = 0.75;
      ctx.beginPath();
      curve.forEach(({ hz, y: value }, at) => (at === 0 ? ctx.moveTo(x(hz), y(value)) : ctx.lineTo(x(hz), y(value))));
      ctx.stroke();
    });
  });
}

/** Each series with its intervals; the point at the cursor stands out. */
export function drawSeries(plot: uPlot, panel: Panel, of: readonly BodeSeries[], at_hz: number | null): void {
  within(plot, (ctx, places) => {
    if (at_hz !== null) drawCursor(ctx, plot, places.x(at_hz));
    panel.series.forEach((dots, i) => drawOne(ctx, places, dots, i, { at_hz, line: of[i]?.line ?? false }));
  });
}

function drawCursor(ctx: CanvasRenderingContext2D, { bbox }: uPlot, left: number): void {
  ctx.strokeStyle = colour("--stale");
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
  ctx.beginPath();
  ctx.moveTo(left, bbox.top);
  ctx.lineTo(left, bbox.top + bbox.height);
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawOne(
  ctx: CanvasRenderingContext2D,
  places: Places,
  dots: readonly Dot[],
  index: number,
  { at_hz, line }: { at_hz: number | null; line: boolean },
): void {
  if (dots.length === 0) return;
  const { x, y } = places;
  const across = x(dots.at(-1)!.hz) - x(dots[0]!.hz);
  const apart = across / Math.max(1, dots.length - 1) >= APART_PX * devicePixelRatio;
  const sparse = !line && (apart || dots.length === 1);
  ctx.strokeStyle = ctx.fillStyle = colour(seriesColour(index));
  if (sparse) drawBars(ctx, places, dots);
  else drawInterval(ctx, places, dots);
  ctx.lineWidth = 1.25 * devicePixelRatio;
  ctx.globalAlpha = sparse ? 0.55 : 1;
  ctx.beginPath();
  dots.forEach(({ hz, y: value }, i) => (i === 0 ? ctx.moveTo(x(hz), y(value)) : ctx.lineTo(x(hz), y(value))));
  ctx.stroke();
  ctx.globalAlpha = 1;
  drawMarks(ctx, places, sparse ? dots : dots.filter(({ hz, settled }) => hz === at_hz || !settled), index, at_hz);
}

/** Filled where the estimate is settled, hollow while it is not. */
function drawMarks(
  ctx: CanvasRenderingContext2D,
  { x, y }: Places,
  dots: readonly Dot[],
  index: number,
  at_hz: number | null,
): void {
  const shape = shapeOf(index);
  for (const { hz, y: value, settled } of dots) {
    const mark = new Path2D();
    outline(mark, shape, x(hz), y(value), (hz === at_hz ? 1.6 : 1) * RADIUS_PX * devicePixelRatio);
    ctx.fillStyle = colour(settled ? seriesColour(index) : "--well");
    ctx.fill(mark);
    ctx.stroke(mark);
  }
}

function drawBars(ctx: CanvasRenderingContext2D, { x, y }: Places, dots: readonly Dot[]): void {
  const half = 3 * devicePixelRatio;
  ctx.lineWidth = devicePixelRatio;
  ctx.beginPath();
  for (const { hz, low, high } of dots) {
    if (low === null || high === null) continue;
    const [middle, top, bottom] = [x(hz), y(high), y(low)];
    if (bottom - top < 2 * RADIUS_PX * devicePixelRatio) continue; // hidden by the mark itself
    ctx.moveTo(middle, top);
    ctx.lineTo(middle, bottom);
    for (const end of [top, bottom]) {
      ctx.moveTo(middle - half, end);
      ctx.lineTo(middle + half, end);
    }
  }
  ctx.stroke();
}

function drawInterval(ctx: CanvasRenderingContext2D, { x, y }: Places, dots: readonly Dot[]): void {
  const known = dots.filter(({ low, high }) => low !== null && high !== null);
  if (known.length < 2) return;
  ctx.globalAlpha = 0.25;
  ctx.beginPath();
  known.forEach(({ hz, high }, i) => (i === 0 ? ctx.moveTo(x(hz), y(high!)) : ctx.lineTo(x(hz), y(high!))));
  for (const { hz, low } of [...known].reverse()) ctx.lineTo(x(hz), y(low!));
  ctx.closePath();
  ctx.fill();
  ctx.globalAlpha = 1;
}

/** Peaks and dips by their figures. */
export function drawCallouts(plot: uPlot, named: readonly Named[]): void {
  const size = fontSize() * devicePixelRatio;
  const { left, top, width, height } = plot.bbox;
  within(plot, (ctx, { x, y }) => {
    ctx.font = `600 ${size.toFixed(1)}px ${colour("--font")}`;
    ctx.textBaseline = "top";
    ctx.textAlign = "left";
    const labels = named.map((one) => ({
      ...{ x: x(one.hz) - left, y: y(one.y) - top, above: one.above },
      width: ctx.measureText(one.text).width + 0.6 * size,
    }));
    place(labels, { width, height, size: 1.25 * size }).forEach((spot, i) => {
      if (spot === null) return;
      const { text, series, hz, y: value, above } = named[i]!;
      ctx.fillStyle = ctx.strokeStyle = colour(seriesColour(series));
      ctx.lineWidth = devicePixelRatio;
      const foot = top + spot.top + (above ? 1.25 * size : 0);
      ctx.beginPath();
      ctx.moveTo(x(hz), y(value) + (above ? -1 : 1) * RADIUS_PX * devicePixelRatio);
      ctx.lineTo(x(hz), foot);
      ctx.stroke();
      ctx.globalAlpha = 0.85;
      ctx.fillStyle = colour("--well");
      ctx.fillRect(left + spot.left, top + spot.top, labels[i]!.width, 1.25 * size);
      ctx.globalAlpha = 1;
      ctx.fillStyle = colour(seriesColour(series));
      ctx.fillText(text, left + spot.left + 0.3 * size, top + spot.top + 0.12 * size);
    });
  });
}
