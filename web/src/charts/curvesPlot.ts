// Calculated curves over one quantity on canvas, several of a kind beside each other, with a cursor.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { axisFigures, type Quantity } from "../units";
import { axes, line, padding, SCALES } from "./options";
import { steadyRange } from "./scale";
import { seriesColour } from "./seriesLook";

const THIN = 1.5;
const THICK = 3;

export interface Curve {
  readonly label: string;
  readonly values: readonly (number | null)[];
  /** Stands out: that of the rig as it is. */
  readonly marked: boolean;
}

export interface Curves {
  readonly across: Quantity;
  readonly up: Quantity;
  readonly x: readonly number[];
  readonly curves: readonly Curve[];
}

export class CurvesPlot {
  private plot: uPlot;
  private readonly ends: (() => void)[];

  /** @param pointed is told the index under the cursor; null where there is none. */
  constructor(
    private readonly host: HTMLElement,
    private data: Curves,
    private readonly pointed: (at: number | null) => void,
  ) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() =>
      this.plot.setSize({ width: host.clientWidth, height: host.clientHeight }),
    );
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.show(this.data)), () => resizing.disconnect()];
  }

  show(data: Curves): void {
    this.data = data;
    this.plot.destroy();
    this.plot = this.build();
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private build(): uPlot {
    const { across, up, x, curves } = this.data;
    const [below, left] = axes({ quantity: up, timeLabels: true });
    const all = curves.flatMap(({ values }) => values.filter((value) => value !== null));
    const y = steadyRange(null, Math.min(0, ...all), Math.max(0, ...all), 0, { centred: false, minSpan: 1e-12 });
    const marks: uPlot.Axis.Values = (_, splits, __, ___, step) =>
      axisFigures(across, splits, step).map((mark) => `${mark}\u00a0${across.symbol}`);
    const plot = new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: [{ ...below, values: marks }, left!],
        series: [{}, ...curves.map(({ label, marked }, i) => line(label, seriesColour(i), marked ? THICK : THIN))],
        cursor: { y: false, drag: { x: false, y: false }, points: { show: false }, sync: { key: "curves", setSeries: false } },
        hooks: { setCursor: [({ cursor }) => this.pointed((cursor.left ?? -1) < 0 ? null : (cursor.idx ?? null))] },
      },
      [[...x], ...curves.map(({ values }) => [...values])],
      this.host,
    );
    plot.batch(() => {
      plot.setScale("x", { min: x[0] ?? 0, max: x.at(-1) ?? 1 });
      plot.setScale("y", y);
    });
    return plot;
  }
}

