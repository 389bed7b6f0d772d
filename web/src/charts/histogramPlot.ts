// Bars over time on canvas, their counts on a logarithmic axis: one late tick in a million is to be seen.

import uPlot from "uplot";
import type { Bars } from "../live/system/histogram";
import { theme } from "../theme.svelte";
import { axisFigures, type Quantity } from "../units";
import { colour } from "./colours";
import { axes, padding, SCALES } from "./options";

const MICROSECONDS: Quantity = { label: "Time", symbol: "µs", scale: 1e6, digits: 0 };
/** A single count stands a little above the axis. */
const FLOOR = -0.3;
const NONE: Bars = { edges_s: [0, 50e-6], counts: [0], beyond: 0 };

export class HistogramPlot {
  private plot: uPlot;
  private bars = NONE;
  private readonly ends: (() => void)[];

  constructor(private readonly host: HTMLElement) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() =>
      this.plot.setSize({ width: host.clientWidth, height: host.clientHeight }),
    );
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(bars: Bars): void {
    this.bars = bars;
    const end = bars.edges_s.at(-1) ?? 0;
    const top = Math.max(1, Math.ceil(Math.log10(Math.max(1, ...bars.counts)) + 0.1));
    this.plot.batch((plot: uPlot) => {
      plot.setData([[0, end], [null, null]], false);
      plot.setScale("x", { min: 0, max: end });
      plot.setScale("y", { min: FLOOR, max: top });
    });
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private build(): uPlot {
    const [across, up] = axes({ quantity: MICROSECONDS, timeLabels: true });
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        cursor: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: [
          {
            ...across,
            values: (_, marks, __, ___, step) =>
              axisFigures(MICROSECONDS, marks, step).map((mark) => `${mark}\u00a0µs`),
          },
          { ...up!, splits: (_, __, ___, max) => decades(max), values: (_, marks) => marks.map(power) },
        ],
        series: [{}, { auto: false }],
        hooks: { draw: [(plot) => this.draw(plot)] },
      },
      [[], []],
      this.host,
    );
  }

  private draw({ ctx, bbox, valToPos }: uPlot): void {
    const { edges_s, counts } = this.bars;
    ctx.save();
    ctx.fillStyle = colour("--bar");
    const floor = bbox.top + bbox.height;
    for (const [i, count] of counts.entries()) {
      if (count === 0) continue;
      const [left, right] = [valToPos(edges_s[i]!, "x", true), valToPos(edges_s[i + 1]!, "x", true)];
      const top = valToPos(Math.log10(count), "y", true);
      ctx.fillRect(left, top, Math.max(1, right - left - 0.5 * devicePixelRatio), floor - top);
    }
    ctx.restore();
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.show(this.bars);
  }
}

const decades = (top: number): number[] => Array.from({ length: Math.floor(top) + 1 }, (_, i) => i);
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const power = (exponent: number): string =>
  exponent < 3 ? String(10 ** exponent) : `10${SUPERSCRIPTS[exponent] ?? exponent}`;
