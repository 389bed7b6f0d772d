// The waveform of a draft on canvas: a band of extremes, the blocks behind it, its peak marked.

import uPlot from "uplot";
import { colour } from "../../charts/colours";
import { axes, fontSize, line, padding, SCALES } from "../../charts/options";
import { steadyRange, type ScaleOptions } from "../../charts/scale";
import type { TimeWindow } from "../../charts/zoom";
import { theme } from "../../theme.svelte";
import { figure, NOTHING, TIME, withUnit, type Quantity } from "../../units";
import { extentOf, peakOf, type Band, type BlockMark } from "./previewBands";

const LEAST_DRAG_PX = 4;
const LEAST_BLOCK_PX = 18;
const PEAK_PX = 4;
const EMPTY: Band = { time_s: [], min: [], max: [] };

export interface PreviewPicture {
  readonly shown: TimeWindow;
  readonly band: Band;
  readonly blocks: readonly BlockMark[];
  /** The block that is being edited, as a person counts. */
  readonly edited: number | null;
}

export interface PreviewEvents {
  selected(window: TimeWindow): void;
  doubleClicked(): void;
  /** What is under the cursor, as words; empty where nothing is. */
  read(text: string): void;
}

export class PreviewPlot {
  private plot: uPlot;
  private picture: PreviewPicture = { shown: { from_s: 0, to_s: 1 }, band: EMPTY, blocks: [], edited: null };
  private fontSize = 0;
  private readonly ends: (() => void)[];

  constructor(
    private readonly host: HTMLElement,
    private readonly quantity: Quantity,
    private readonly scale: ScaleOptions,
    private readonly timeLabels: boolean,
    /** Whether the blocks' numbers are written above them. */
    private readonly numbered: boolean,
    private readonly events: PreviewEvents,
  ) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() => this.resize());
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  show(picture: PreviewPicture): void {
    this.picture = picture;
    this.draw();
  }

  private draw(): void {
    const { shown, band } = this.picture;
    const { low, high } = extentOf(band);
    const { min, max } = steadyRange(null, low, high, 0, this.scale);
    this.plot.batch((u: uPlot) => {
      u.setData([band.time_s, band.max, band.min] as unknown as uPlot.AlignedData, false);
      u.setScale("x", { min: shown.from_s, max: shown.to_s });
      u.setScale("y", { min, max });
    });
  }

  private build(): uPlot {
    this.fontSize = fontSize();
    const extreme = line(this.quantity.label, "--setpoint", 1.25);
    const options: uPlot.Options = {
      width: this.host.clientWidth,
      height: this.host.clientHeight,
      legend: { show: false },
      padding: this.padding(),
      scales: SCALES,
      axes: axes({ quantity: this.quantity, timeLabels: this.timeLabels }),
      series: [{}, extreme, { ...extreme }],
      bands: [
        { series: [1, 2], fill: () => `color-mix(in srgb, ${colour("--setpoint")} 40%, transparent)` },
      ],
      cursor: {
        y: false,
        drag: { x: true, y: false, setScale: false, dist: LEAST_DRAG_PX },
        bind: { dblclick: () => () => (this.events.doubleClicked(), null) },
        sync: { key: "preview", setSeries: false },
      },
      hooks: {
        drawClear: [(u) => this.drawBlocks(u)],
        draw: [(u) => this.drawPeak(u)],
        setCursor: [() => this.readOut()],
        setSelect: [(u) => this.select(u)],
      },
    };
    return new uPlot(options, [[], [], []], this.host);
  }

  private padding(): [number, number, number, number] {
    const [top, right, bottom, left] = padding();
    return [this.numbered ? 2 * top : top, right, bottom, left];
  }

  /** A line where a block begins, its number where there is room, the one being edited on lighter ground. */
  private drawBlocks(u: uPlot): void {
    const { ctx, bbox } = u;
    const size = Math.round(fontSize() * devicePixelRatio);
    ctx.save();
    ctx.font = `${size}px ${colour("--font")}`;
    ctx.textBaseline = "top";
    let free = -Infinity;
    for (const { from_s, to_s, number } of this.picture.blocks) {
      const from = Math.max(bbox.left, u.valToPos(from_s, "x", true));
      const to = Math.min(bbox.left + bbox.width, u.valToPos(to_s, "x", true));
      ctx.fillStyle = colour("--panel");
      if (number === this.picture.edited) ctx.fillRect(from, bbox.top, to - from, bbox.height);
      if (from < free) continue;
      free = from + LEAST_BLOCK_PX * devicePixelRatio;
      ctx.fillStyle = colour("--line");
      ctx.fillRect(Math.round(from), bbox.top, Math.max(1, devicePixelRatio), bbox.height);
      ctx.fillStyle = colour("--ink-2");
      if (this.numbered && to - from >= LEAST_BLOCK_PX * devicePixelRatio)
        ctx.fillText(String(number), from + size / 3, bbox.top - size / 2);
    }
    ctx.restore();
  }

  private drawPeak(u: uPlot): void {
    const peak = peakOf(this.picture.band);
    if (peak === null) return;
    const { ctx, bbox } = u;
    const [x, y] = [u.valToPos(peak.time_s, "x", true), u.valToPos(peak.value, "y", true)];
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    const size = Math.round(fontSize() * devicePixelRatio);
    const left = x > bbox.left + bbox.width * 0.8;
    ctx.save();
    ctx.font = `600 ${size}px ${colour("--font")}`;
    ctx.textAlign = left ? "right" : "left";
    ctx.textBaseline = "middle";
    ctx.strokeStyle = ctx.fillStyle = colour("--ink");
    ctx.lineWidth = 1.5 * devicePixelRatio;
    ctx.beginPath();
    ctx.arc(x, y, PEAK_PX * devicePixelRatio, 0, 2 * Math.PI);
    ctx.stroke();
    const text = withUnit(this.quantity, peak.value);
    const at = Math.min(Math.max(y, bbox.top + size * 0.7), bbox.top + bbox.height - size * 0.7);
    const width = ctx.measureText(text).width + size / 2;
    ctx.fillStyle = colour("--well");
    ctx.fillRect(left ? x - size * 0.75 - width : x + size * 0.75, at - size * 0.65, width, size * 1.3);
    ctx.fillStyle = colour("--ink");
    ctx.fillText(text, x + (left ? -size : size), at);
    ctx.restore();
  }

  private select(u: uPlot): void {
    const { left, width } = u.select;
    if (width < LEAST_DRAG_PX) return;
    this.events.selected({ from_s: u.posToVal(left, "x"), to_s: u.posToVal(left + width, "x") });
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  }

  private readOut(): void {
    const { idx, left } = this.plot?.cursor ?? {};
    const { band } = this.picture;
    if (typeof idx !== "number" || (left ?? -1) < 0) return this.events.read("");
    const [low, high] = [band.min[idx], band.max[idx]];
    const single = low === high;
    const value = single
      ? withUnit(this.quantity, low, 1)
      : `${figure(this.quantity, low, 1)} … ${withUnit(this.quantity, high, 1)}`;
    this.events.read(low === undefined ? NOTHING : `${withUnit(TIME, band.time_s[idx], 1)}  ${value}`);
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.draw();
  }

  private resize(): void {
    if (fontSize() !== this.fontSize) return this.rebuild();
    this.plot.setSize({ width: this.host.clientWidth, height: this.host.clientHeight });
  }
}
