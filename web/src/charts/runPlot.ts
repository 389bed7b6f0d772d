// A recorded run on canvas: bands of extremes when far away, single ticks when close.

import uPlot from "uplot";
import { pointAt } from "../live/scene";
import type { RunSamples } from "../live/types";
import { theme } from "../theme.svelte";
import { quantityOf, TIME, withUnit } from "../units";
import { bandData, bandExtent, bandFigure, place } from "./bands";
import { colour } from "./colours";
import { listen } from "./gestures";
import type { Readout } from "./livePlot";
import { drawMarks, type Mark } from "./marks";
import { axes, line, padding, SCALES } from "./options";
import { drawLimits, drawOverlay, limitsNear, overlayExtent, type Overlay } from "./overlays";
import { steadyRange } from "./scale";
import { colourOf, type ChartInfo, type SeriesInfo } from "./series";
import type { TimeWindow } from "./zoom";

const LEAST_DRAG_PX = 4;
const SETTLE_MS = 200;
const LEAST_POINTS = 200;
/** Ticks farther apart than this are drawn as points, too. */
const APART_PX = 7;

export interface RunPlotEvents {
  /** A stretch of time was dragged over. */
  selected(window: TimeWindow): void;
  doubleClicked(): void;
  /** Zoom around a moment; `again`: the same gesture goes on. */
  zoomed(at_s: number, factor: number, again: boolean): void;
  moved(by_s: number): void;
  /** How many points are worth fetching at the present width: two a pixel. */
  fits(points: number): void;
}

/** What is drawn beside the samples. */
export interface Adornments {
  readonly marks: readonly Mark[];
  readonly overlays: readonly Overlay[];
  /** Values, SI. */
  readonly limits: readonly number[];
}

export class RunPlot {
  private plot: uPlot;
  private readonly series: readonly SeriesInfo[];
  private readonly channels: readonly string[];
  private readonly quantity;
  private samples: RunSamples | null = null;
  private window: TimeWindow = { from_s: 0, to_s: 1 };
  private adornments: Adornments = { marks: [], overlays: [], limits: [] };
  private settling = 0;
  private deaf: () => void = () => undefined;
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly info: ChartInfo,
    private readonly timeLabels: boolean,
    private readonly readout: Readout,
    private readonly events: RunPlotEvents,
  ) {
    this.series = info.series.filter((entry) => !entry.off);
    this.channels = this.series.map((entry) => entry.channel);
    this.quantity = quantityOf(this.channels[0]!);
    this.plot = this.build();
    this.fit();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect(), () => this.deaf()];
  }

  destroy(): void {
    window.clearTimeout(this.settling);
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  /** Shows a window of time with the samples there are: an old picture until the finer one has come. */
  show(shown: TimeWindow, samples: RunSamples | null): void {
    this.window = shown;
    this.samples = samples;
    this.draw();
  }

  adorn(adornments: Adornments): void {
    this.adornments = adornments;
    this.draw();
  }

  private draw(): void {
    const { samples, channels, window: shown } = this;
    if (!samples) return;
    const { min, max } = this.range(samples);
    this.plot.batch((u: uPlot) => {
      u.setData(bandData(samples, channels), false);
      u.setScale("x", { min: shown.from_s, max: shown.to_s });
      u.setScale("y", { min, max });
    });
  }

  /** Room for the samples, what lies over them, and the limits that are near. */
  private range(samples: RunSamples): { min: number; max: number } {
    const measured = bandExtent(samples, this.channels, this.window);
    const over = overlayExtent(this.adornments.overlays, this.window);
    const low = Math.min(measured.low, over.low);
    const high = Math.max(measured.high, over.high);
    const near = limitsNear(this.adornments.limits, low, high);
    return steadyRange(null, Math.min(low, ...near), Math.max(high, ...near), 0, { ...this.info.scale, centred: false });
  }

  private build(): uPlot {
    const isSparse = (plot: uPlot): boolean => this.columnsInView() < plot.bbox.width / devicePixelRatio / APART_PX;
    const lines = this.series.flatMap(({ label, role }) => {
      const extreme = { ...line(label, colourOf(role), 1.25), points: { show: isSparse, size: 5 } };
      return [extreme, { ...extreme }];
    });
    const options: uPlot.Options = {
      width: this.host.clientWidth,
      height: this.host.clientHeight,
      legend: { show: false },
      padding: padding(),
      scales: SCALES,
      axes: axes({ quantity: this.quantity, timeLabels: this.timeLabels }),
      series: [{}, ...lines],
      bands: this.series.map(({ role }, i) => ({
        series: [2 * i + 2, 2 * i + 1] as [number, number],
        fill: () => `color-mix(in srgb, ${colour(colourOf(role))} 45%, transparent)`,
      })),
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: false, dist: LEAST_DRAG_PX },
        bind: { dblclick: () => () => (this.events.doubleClicked(), null) },
        sync: { key: "run", setSeries: false },
      },
      hooks: {
        drawAxes: [
          (plot) => {
            drawMarks(plot, this.adornments.marks);
            drawLimits(plot, this.adornments.limits);
            for (const overlay of this.adornments.overlays) drawOverlay(plot, overlay);
          },
        ],
        setCursor: [() => this.readOut()],
        setSelect: [(plot) => this.select(plot)],
      },
    };
    const plot = new uPlot(options, [[], ...lines.map(() => [])], this.host);
    this.deaf();
    this.deaf = listen(plot.over, {
      zoom: (at, factor, again) => this.events.zoomed(plot.posToVal(at, "x"), factor, again),
      move: (by) => this.events.moved((-by / plot.over.clientWidth) * (this.window.to_s - this.window.from_s)),
    });
    return plot;
  }

  private columnsInView(): number {
    const { samples, window: shown } = this;
    if (samples === null || samples.decimated) return Infinity;
    return (place(samples, shown.to_s) ?? 0) - (place(samples, shown.from_s) ?? 0);
  }

  private select(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width < LEAST_DRAG_PX) return;
    this.events.selected({ from_s: plot.posToVal(left, "x"), to_s: plot.posToVal(left + width, "x") });
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
    this.events.fits(Math.max(LEAST_POINTS, Math.round(2 * this.plot.over.clientWidth)));
  }

  private readOut(): void {
    const left = this.plot?.cursor.left ?? -1;
    const { samples } = this;
    const at = samples && left >= 0 ? place(samples, this.plot.posToVal(left, "x")) : null;
    this.readout.time.textContent = at === null ? "" : withUnit(TIME, samples?.time_s[at], 3);
    pointAt(at === null ? null : (samples?.time_s[at] ?? null));
    this.channels.forEach((channel, i) => {
      const field = this.readout.values[i];
      if (field) {
        field.textContent = at === null || !samples ? "" : bandFigure(samples, channel, at, this.quantity);
      }
    });
  }
}
