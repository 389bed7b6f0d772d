// Several runs on one canvas: a line of extremes each, over time or phase, with tolerance and stretches beyond it.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { ANGLE, axisFigures, TIME, type Quantity } from "../units";
import { colour } from "./colours";
import { axes, padding, SCALES } from "./options";
import { steadyRange } from "./scale";
import type { SeriesLine } from "./seriesLine";

type Numbers = readonly (number | null)[];

export interface OverlayTrace {
  readonly line: SeriesLine;
  readonly min: Numbers;
  readonly max: Numbers;
}

export interface OverlayPicture {
  readonly x: readonly number[];
  readonly unit: "s" | "°";
  readonly traces: readonly OverlayTrace[];
  /** Half the width of a band about zero. */
  readonly tolerance: Numbers | null;
  /** Stretches of the axis that are marked. */
  readonly exceeded: readonly { readonly first: number; readonly last: number }[];
}

export interface OverlayEvents {
  /** A stretch of the axis was dragged over. */
  selected(from: number, to: number): void;
  doubleClicked(): void;
  /** The pointer is at this place of the axis; null where it is elsewhere. */
  pointed(index: number | null): void;
  /** How many points are worth asking for at the present width. */
  fits(points: number): void;
}

const EMPTY: OverlayPicture = { x: [], unit: "s", traces: [], tolerance: null, exceeded: [] };
const LEAST_DRAG_PX = 4;
const LEAST_MARK_PX = 2;
const SETTLE_MS = 200;
const LEAST_SPAN = 0.02; // of one shown unit

export class OverlayPlot {
  private plot: uPlot;
  private picture: OverlayPicture = EMPTY;
  private settling = 0;
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private quantity: Quantity,
    private readonly labels: boolean,
    private readonly events: OverlayEvents,
  ) {
    this.plot = this.build();
    this.fit();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(picture: OverlayPicture, quantity: Quantity): void {
    const before = this.picture;
    const same = before.traces.length === picture.traces.length && before.unit === picture.unit;
    const drawn = same && picture.traces.every(({ line }, i) => line.colour === before.traces[i]!.line.colour);
    this.picture = picture;
    if (drawn && quantity === this.quantity && (before.tolerance === null) === (picture.tolerance === null)) this.draw();
    else {
      this.quantity = quantity;
      this.rebuild();
    }
  }

  destroy(): void {
    window.clearTimeout(this.settling);
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private draw(): void {
    const { x, traces, tolerance } = this.picture;
    const limits = tolerance === null ? [] : [tolerance.map((t) => (t === null ? null : -t)), tolerance];
    const columns = [...limits, ...traces.flatMap(({ min, max }) => [min, max])];
    const [low, high] = extent(columns);
    const range = steadyRange(null, low, high, 0, { centred: tolerance !== null, minSpan: LEAST_SPAN / this.quantity.scale });
    this.plot.batch((plot: uPlot) => {
      plot.setData([x, ...columns] as unknown as uPlot.AlignedData, false);
      plot.setScale("x", { min: x[0] ?? 0, max: x.at(-1) ?? 1 });
      plot.setScale("y", range);
    });
  }

  private build(): uPlot {
    const { traces, tolerance } = this.picture;
    const limits = tolerance === null ? [] : [this.limit(), this.limit()];
    const lines = traces.flatMap(({ line }) => [this.line(line), this.line(line)]);
    const skip = limits.length;
    const bands: uPlot.Band[] = traces.map(({ line }, i) => ({
      series: [skip + 2 * i + 2, skip + 2 * i + 1],
      fill: () => `color-mix(in srgb, ${colour(line.colour)} 38%, transparent)`,
    }));
    if (skip > 0) bands.push({ series: [2, 1], fill: () => `color-mix(in srgb, ${colour("--setpoint")} 16%, transparent)` });
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: this.axes(),
        series: [{}, ...limits, ...lines],
        bands,
        cursor: {
          y: false,
          points: { show: false },
          drag: { x: true, y: false, setScale: false, dist: LEAST_DRAG_PX },
          bind: { dblclick: () => () => (this.events.doubleClicked(), null) },
          sync: { key: "compare", setSeries: false },
        },
        hooks: {
          drawAxes: [(plot) => this.mark(plot)],
          setCursor: [({ cursor }) => this.events.pointed((cursor.left ?? -1) < 0 ? null : (cursor.idx ?? null))],
          setSelect: [(plot) => this.select(plot)],
        },
      },
      [[], ...limits.map(() => []), ...lines.map(() => [])],
      this.host,
    );
  }

  private axes(): uPlot.Axis[] {
    const [across, up] = axes({ quantity: this.quantity, timeLabels: this.labels });
    if (this.picture.unit === "s") return [across!, up!];
    const values: uPlot.Axis.DynamicValues = (_, marks, __, ___, step) =>
      this.labels ? axisFigures(ANGLE, marks, step).map((mark) => `${mark}${ANGLE.symbol}`) : marks.map(() => "");
    return [{ ...across!, incrs: [5, 10, 15, 30, 45, 90], values }, up!];
  }

  private line({ colour: name, dash }: SeriesLine): uPlot.Series {
    const common = { width: 1.25, points: { show: false }, spanGaps: false, auto: false };
    return { ...common, stroke: () => colour(name), dash: [...dash] };
  }

  private limit(): uPlot.Series {
    return { width: 1, stroke: () => colour("--setpoint"), points: { show: false }, spanGaps: false, auto: false };
  }

  /** Where a difference exceeds its tolerance: a stripe along the axis. */
  private mark(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const least = LEAST_MARK_PX * devicePixelRatio;
    const height = 4 * devicePixelRatio;
    ctx.save();
    ctx.fillStyle = colour("--error");
    for (const { first, last } of this.picture.exceeded) {
      const left = Math.max(bbox.left, plot.valToPos(first, "x", true));
      const right = Math.min(bbox.left + bbox.width, Math.max(left + least, plot.valToPos(last, "x", true)));
      if (right > left) ctx.fillRect(left, bbox.top + bbox.height - height, right - left, height);
    }
    ctx.restore();
  }

  private select(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width < LEAST_DRAG_PX) return;
    this.events.selected(plot.posToVal(left, "x"), plot.posToVal(left + width, "x"));
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.draw();
  }

  private resize(): void {
    this.plot.setSize({ width: this.host.clientWidth, height: this.host.clientHeight });
    window.clearTimeout(this.settling);
    this.settling = window.setTimeout(() => this.fit(), SETTLE_MS);
  }

  private fit(): void {
    this.events.fits(2 * this.plot.over.clientWidth);
  }
}

/** Least and greatest of columns; NaN where there is none. */
function extent(columns: readonly Numbers[]): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const column of columns) {
    for (const value of column) {
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [NaN, NaN];
}

/** The place of the axis, as it is read out. */
export const placeQuantity = (unit: "s" | "°"): Quantity => (unit === "s" ? TIME : ANGLE);
