// One panel of a frequency response on canvas: uPlot gives axes and cursor, the rest is drawn here.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { axisFigures, FREQUENCY, gainQuantity, PLAIN } from "../units";
import type { BodeData, Panel, PanelName } from "./bode";
import { drawBands, drawCallouts, drawModels, drawSeries, type Named } from "./bodeDrawing";
import { logTicks } from "./logTicks";
import { axes, fontSize, padding, SCALES } from "./options";

const INCREMENTS: Record<PanelName, number[]> = {
  gain: [0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 20, 40, 100],
  phase: [1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720],
  coherence: [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5],
};
const NOTHING: Panel = { series: [], models: [], bands: [], range: { min: -1, max: 1 } };

export interface BodePanelEvents {
  /** The pointer is at this frequency; null where it is not over the panel. */
  pointed(hz: number | null): void;
}

export class BodePanel {
  private plot: uPlot;
  private panel: Panel = NOTHING;
  private data: BodeData = { series: [], models: [], bands: [], unit: "1", decibels: true };
  private named: readonly Named[] = [];
  private range = { min: 1, max: 100 };
  private at: number | null = null;
  private fontSize = 0;
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly name: PanelName,
    private readonly frequencyLabels: boolean,
    private readonly events: BodePanelEvents,
  ) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(data: BodeData, panel: Panel, range: { min: number; max: number }, named: readonly Named[]): void {
    [this.data, this.panel, this.range, this.named] = [data, panel, range, named];
    this.draw();
  }

  /** A line at this frequency. */
  point(hz: number | null): void {
    if (hz === this.at) return;
    this.at = hz;
    this.plot.redraw(false);
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private draw(): void {
    const { min, max } = this.panel.range;
    this.plot.batch((plot: uPlot) => {
      plot.setData([[this.range.min, this.range.max], [null, null]], false);
      plot.setScale("x", this.range);
      plot.setScale("y", { min, max });
    });
  }

  private build(): uPlot {
    this.fontSize = fontSize();
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
        padding: padding(),
        scales: { ...SCALES, x: { ...SCALES["x"], distr: 3, log: 10 } },
        axes: this.axes(),
        series: [{}, { auto: false }],
        hooks: {
          drawAxes: [(plot) => drawBands(plot, this.panel)],
          draw: [(plot) => this.drawOver(plot)],
          setCursor: [({ cursor, posToVal }) => this.events.pointed(pointed(cursor.left, posToVal))],
        },
      },
      [[], []],
      this.host,
    );
  }

  private drawOver(plot: uPlot): void {
    drawModels(plot, this.panel, this.data.models);
    drawSeries(plot, this.panel, this.data.series, this.at);
    if (this.name === "gain" && this.data.decibels) drawCallouts(plot, this.named);
  }

  private axes(): uPlot.Axis[] {
    const [across, up] = axes({ quantity: PLAIN, timeLabels: this.frequencyLabels });
    const size = fontSize();
    const room = (plot: uPlot): number => plot.bbox.width / devicePixelRatio / (4.2 * size);
    const frequency: uPlot.Axis = {
      ...across,
      splits: (plot, _, min, max) => [...logTicks(min, max, room(plot)).at],
      filter: (_, marks) => marks,
      values: (plot, marks) => {
        if (!this.frequencyLabels) return marks.map(() => "");
        const { labelled } = logTicks(plot.scales["x"]!.min!, plot.scales["x"]!.max!, room(plot));
        return marks.map((mark) => (labelled.has(mark) ? `${Number(mark.toPrecision(6))}\u00a0${FREQUENCY.symbol}` : ""));
      },
    };
    const plain: uPlot.Axis = { ...up, incrs: INCREMENTS[this.name] };
    return [frequency, { gain: () => this.gainAxis(up!), phase: () => plain, coherence: () => coherenceAxis(plain) }[this.name]()];
  }

  /** In dB an even axis; in a unit its marks are those of a logarithmic one. */
  private gainAxis(up: uPlot.Axis): uPlot.Axis {
    const inDb = (): boolean => this.data.decibels;
    const room = (plot: uPlot): number => plot.bbox.height / devicePixelRatio / (2 * fontSize());
    const ticks = (plot: uPlot) =>
      logTicks(10 ** plot.scales["y"]!.min!, 10 ** plot.scales["y"]!.max!, room(plot));
    return {
      ...up,
      incrs: INCREMENTS.gain,
      splits: (plot, _, min, max, step) =>
        inDb() ? evenly(min, max, step) : ticks(plot).at.map((mark) => Math.log10(mark)),
      values: (plot, marks, _, __, step) => {
        if (inDb()) return axisFigures(PLAIN, marks, step);
        const { at, labelled } = ticks(plot);
        return at.map((mark) => (labelled.has(mark) ? String(Number(mark.toPrecision(6))) : ""));
      },
    };
  }

  private resize(): void {
    if (fontSize() !== this.fontSize) return this.rebuild();
    this.plot.setSize({ width: this.host.clientWidth, height: this.host.clientHeight });
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.draw();
  }
}

/** There is none above one. */
const coherenceAxis = (up: uPlot.Axis): uPlot.Axis => ({
  ...up,
  space: 1.6 * fontSize(),
  splits: (_, __, min, max, step) => evenly(Math.max(0, min), Math.min(1, max), step),
});

function evenly(min: number, max: number, step: number): number[] {
  const first = Math.ceil(min / step - 1e-9);
  const marks = Math.max(0, Math.floor(max / step + 1e-9) - first + 1);
  return Array.from({ length: marks }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

const pointed = (left: number | undefined, toValue: (at: number, scale: string) => number): number | null =>
  left === undefined || left < 0 ? null : toValue(left, "x");

/** The unit that a panel's axis is in. */
export function symbolOf(name: PanelName, { unit, decibels }: Pick<BodeData, "unit" | "decibels">): string {
  if (name === "phase") return "°";
  if (name === "coherence") return "";
  if (!decibels) return gainQuantity(unit).symbol;
  return unit === "1" ? "dB" : `dB re 1\u00a0${unit}`;
}

