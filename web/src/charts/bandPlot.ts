// One foreseen quantity on canvas: a band of extremes in the colour of what is commanded.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import type { Quantity } from "../units";
import { colour } from "./colours";
import { axes, line, padding, SCALES } from "./options";
import { steadyRange } from "./scale";

export interface BandTrace {
  readonly time_s: readonly number[];
  readonly min: readonly (number | null)[];
  readonly max: readonly (number | null)[];
}

const LEAST_SPAN = 0.1; // of one shown unit: noise of nothing is not blown up to a signal

export class BandPlot {
  private plot: uPlot;
  private trace: BandTrace = { time_s: [], min: [], max: [] };
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly quantity: Quantity,
    private readonly timeLabels: boolean,
  ) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(trace: BandTrace): void {
    this.trace = trace;
    const { time_s, min, max } = trace;
    const values = [...min, ...max].filter((value): value is number => value !== null);
    const low = values.reduce((a, b) => Math.min(a, b), Infinity);
    const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
    const range = steadyRange(null, low, high, 0, { centred: false, minSpan: LEAST_SPAN / this.quantity.scale });
    this.plot.batch((plot: uPlot) => {
      plot.setData([time_s, min, max] as unknown as uPlot.AlignedData, false);
      plot.setScale("x", { min: time_s[0] ?? 0, max: time_s.at(-1) ?? 1 });
      plot.setScale("y", { min: range.min, max: range.max });
    });
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private build(): uPlot {
    const extreme = line("", "--setpoint", 1.5);
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        cursor: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: axes({ quantity: this.quantity, timeLabels: this.timeLabels }),
        series: [{}, extreme, { ...extreme }],
        bands: [{ series: [2, 1], fill: () => `color-mix(in srgb, ${colour("--setpoint")} 45%, transparent)` }],
      },
      [[], [], []],
      this.host,
    );
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.show(this.trace);
  }

  private resize(): void {
    this.plot.setSize({ width: this.host.clientWidth, height: this.host.clientHeight });
  }
}
