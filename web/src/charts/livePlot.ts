// One live chart on canvas. It looks at the samples once a frame and draws only when something is new.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { figure, NOTHING, quantityOf, TIME, withUnit } from "../units";
import { drawBars } from "./columns";
import { onFrame } from "./frames";
import { shadeGaps } from "./gaps";
import { axes, fontSize, line, padding, SCALES } from "./options";
import { steadyRange, type SteadyRange } from "./scale";
import { colourOf, type ChartInfo } from "./series";
import { Trace } from "./trace";
import { view } from "./view.svelte";

const straight = uPlot.paths.linear!();
const COMMANDED_PX = 1.75;
const MEASURED_PX = 1.25;

/** Where the values under the cursor are written: straight into the page, no reactive state at frame rate. */
export interface Readout {
  readonly time: HTMLElement;
  readonly values: readonly (HTMLElement | undefined)[];
}

export class LivePlot {
  private plot: uPlot;
  private readonly trace: Trace;
  private readonly quantity;
  private readonly shown: boolean[];
  private range: SteadyRange | null = null;
  /** What was drawn last; empty when it must be drawn again. */
  private drawn = "";
  private fontSize = 0;
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly info: ChartInfo,
    private readonly timeLabels: boolean,
    private readonly readout: Readout,
  ) {
    this.trace = new Trace(info.series.map((entry) => entry.channel));
    this.quantity = quantityOf(info.series[0]!.channel);
    this.shown = info.series.map((entry) => !entry.off);
    this.plot = this.build();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [
      onFrame((now_ms) => this.draw(now_ms)),
      theme.onChange(() => this.rebuild()),
      () => resizing.disconnect(),
    ];
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  show(series: number, shown: boolean): void {
    this.shown[series] = shown;
    this.plot.setSeries(series + 1, { show: shown });
    this.drawn = "";
  }

  private draw(now_ms: number): void {
    const { ring, period_s } = view.samples();
    const now = `${ring.generation} ${ring.endTick} ${view.window_s}`;
    if (now === this.drawn) return;
    this.drawn = now;
    const { trace, plot } = this;
    trace.update(ring, view.window_s, period_s, plot.bbox.width, this.shown);
    const steady = steadyRange(this.range, trace.low, trace.high, now_ms / 1000, this.info.scale);
    if (Number.isFinite(trace.low)) this.range = steady;
    plot.batch(() => {
      plot.setData([trace.x, ...trace.ys], false);
      plot.setScale("x", { min: -view.window_s, max: 0 });
      plot.setScale("y", { min: steady.min, max: steady.max });
    });
    this.readOut();
  }

  private build(): uPlot {
    this.fontSize = fontSize();
    const { host, info, trace, shown } = this;
    const options: uPlot.Options = {
      width: host.clientWidth,
      height: host.clientHeight,
      legend: { show: false },
      padding: padding(),
      scales: SCALES,
      axes: axes({ quantity: this.quantity, timeLabels: this.timeLabels }),
      series: [
        {},
        ...info.series.map(({ label, role }, i) => ({
          ...line(label, colourOf(role), role === "commanded" ? COMMANDED_PX : MEASURED_PX),
          show: shown[i] ?? true,
          paths: (u: uPlot, at: number, from: number, to: number) =>
            trace.bucket > 1 ? null : straight(u, at, from, to),
        })),
      ],
      cursor: {
        y: false,
        drag: { x: false, y: false },
        points: { size: 6 },
        sync: { key: "live", setSeries: false },
      },
      hooks: {
        drawClear: [(u) => shadeGaps(u, view.samples().ring, view.samples().period_s)],
        drawSeries: [(u, at) => (trace.bucket > 1 ? drawBars(u, at) : undefined)],
        setCursor: [() => this.readOut()],
      },
    };
    return new uPlot(options, [[], ...info.series.map(() => [])], host);
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.drawn = "";
  }

  private resize(): void {
    if (fontSize() !== this.fontSize) return this.rebuild();
    this.plot.setSize({ width: this.host.clientWidth, height: this.host.clientHeight });
    this.drawn = "";
  }

  private readOut(): void {
    const { idx, left } = this.plot?.cursor ?? {};
    const at = typeof idx === "number" && (left ?? -1) >= 0 ? idx : null;
    this.readout.time.textContent = at === null ? "" : withUnit(TIME, this.trace.x[at], 2);
    this.readout.values.forEach((field, i) => {
      if (field) field.textContent = at === null || !this.shown[i] ? "" : this.valueAt(i, at);
    });
  }

  private valueAt(series: number, at: number): string {
    const y = this.trace.ys[series]!;
    if (this.trace.bucket === 1) return figure(this.quantity, y[at], 1);
    const start = at - (at % 2);
    const pair = [y[start], y[start + 1]].filter((value) => typeof value === "number");
    if (pair.length === 0) return NOTHING;
    return `${figure(this.quantity, Math.min(...pair), 1)} … ${figure(this.quantity, Math.max(...pair), 1)}`;
  }
}
