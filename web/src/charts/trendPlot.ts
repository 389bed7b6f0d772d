// A measurement over many runs on canvas: a dot each, the line through them, and the limits that were asked for.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { localTime, type Quantity } from "../units";
import { colour } from "./colours";
import { axes, fontSize, line, padding, SCALES } from "./options";
import { steadyRange } from "./scale";

export interface TrendPicture {
  /** Seconds since 1970, ascending; one value each, SI. */
  readonly at: readonly number[];
  readonly values: readonly number[];
  /** The line at the first and the last of them; null where there is none. */
  readonly line: { readonly first: number; readonly last: number } | null;
  readonly limits: readonly number[];
  /** Places of those that are marked. */
  readonly marked: readonly number[];
}

const MARGIN = 0.03; // of the span, left and right
const LEAST_S = 60;
const DOT_PX = 3.5;

export class TrendPlot {
  private plot: uPlot;
  private picture: TrendPicture = { at: [], values: [], line: null, limits: [], marked: [] };
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private quantity: Quantity,
    private readonly pointed: (index: number | null) => void,
  ) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() =>
      this.plot.setSize({ width: host.clientWidth, height: host.clientHeight }),
    );
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(picture: TrendPicture, quantity: Quantity): void {
    this.picture = picture;
    if (quantity === this.quantity) this.draw();
    else {
      this.quantity = quantity;
      this.rebuild();
    }
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private draw(): void {
    const { at, values, line: through, limits } = this.picture;
    const all = [...values, ...limits, ...(through === null ? [] : [through.first, through.last])];
    const [low, high] = [Math.min(...all), Math.max(...all)];
    const [first, last] = [at[0] ?? 0, at.at(-1) ?? 1];
    const margin = MARGIN * Math.max(LEAST_S, last - first);
    const range = steadyRange(null, low, high, 0, { centred: false, minSpan: 1e-3 * Math.max(1e-12, Math.abs(high)) });
    this.plot.batch((plot: uPlot) => {
      plot.setData([at, values, this.lineValues()] as unknown as uPlot.AlignedData, false);
      plot.setScale("x", { min: first - margin, max: last + margin });
      plot.setScale("y", range);
    });
  }

  private lineValues(): (number | null)[] {
    const { at, line: through } = this.picture;
    const [first, last] = [at[0] ?? 0, at.at(-1) ?? 0];
    if (through === null || last <= first) return at.map(() => null);
    return at.map((t) => through.first + ((through.last - through.first) * (t - first)) / (last - first));
  }

  private build(): uPlot {
    const [across, up] = axes({ quantity: this.quantity, timeLabels: true });
    const size = fontSize();
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: [
          { ...across!, space: 9 * size, values: (_, marks, __, ___, step) => marks.map((mark) => moment(mark, step)) },
          up!,
        ],
        series: [{}, { ...line("", "--measured", 0), paths: () => null }, { ...line("", "--setpoint", 1.5), spanGaps: true }],
        cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
        hooks: {
          drawAxes: [(plot) => this.drawLimits(plot)],
          draw: [(plot) => this.drawDots(plot)],
          setCursor: [({ cursor }) => this.pointed((cursor.left ?? -1) < 0 ? null : (cursor.idx ?? null))],
        },
      },
      [[], [], []],
      this.host,
    );
  }

  private drawLimits(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = colour("--error");
    ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
    for (const limit of this.picture.limits) {
      const y = plot.valToPos(limit, "y", true);
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
    ctx.restore();
  }

  private drawDots(plot: uPlot): void {
    const { ctx } = plot;
    const { at, values, marked } = this.picture;
    ctx.save();
    ctx.lineWidth = 2 * devicePixelRatio;
    at.forEach((t, i) => {
      ctx.fillStyle = ctx.strokeStyle = colour(marked.includes(i) ? "--commanded" : "--measured");
      ctx.beginPath();
      const radius = DOT_PX * devicePixelRatio * (marked.includes(i) ? 1.5 : 1);
      ctx.arc(plot.valToPos(t, "x", true), plot.valToPos(values[i]!, "y", true), radius, 0, 2 * Math.PI);
      ctx.fill();
    });
    ctx.restore();
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.draw();
  }
}

/** A moment at an axis: a day, or a time of day where the marks are closer. */
function moment(at_s: number, step_s: number): string {
  const text = localTime(new Date(1000 * at_s).toISOString());
  const [day = "", time = ""] = text.split(/[ ,]+/);
  return step_s >= 86_400 ? day : time === "" ? text : time;
}
