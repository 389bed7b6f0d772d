// Force over displacement on canvas; uPlot gives the axes, the path is drawn here.

import uPlot from "uplot";
import { theme } from "../theme.svelte";
import { axisFigures, FORCE, LENGTH } from "../units";
import { colour } from "./colours";
import { axes, padding, SCALES } from "./options";
import { steadyRange } from "./scale";
import { around, type Box } from "./xy";

const LEAST_X = { centred: false, minSpan: 1e-4 };
const LEAST_Y = { centred: false, minSpan: 100 };

export class XyPlot {
  private plot: uPlot;
  private boxes: readonly Box[] = [];
  private readonly ends: (() => void)[];

  constructor(private readonly host: HTMLElement) {
    this.plot = this.build();
    const resizing = new ResizeObserver(() =>
      this.plot.setSize({ width: host.clientWidth, height: host.clientHeight }),
    );
    resizing.observe(host);
    this.ends = [theme.onChange(() => this.rebuild()), () => resizing.disconnect()];
  }

  show(boxes: readonly Box[]): void {
    this.boxes = boxes;
    const all = around(boxes) ?? { x: [0, 0], y: [0, 0] };
    const x = steadyRange(null, all.x[0], all.x[1], 0, LEAST_X);
    const y = steadyRange(null, all.y[0], all.y[1], 0, LEAST_Y);
    this.plot.batch((plot: uPlot) => {
      plot.setData([[x.min, x.max], [null, null]], false);
      plot.setScale("x", { min: x.min, max: x.max });
      plot.setScale("y", { min: y.min, max: y.max });
    });
  }

  destroy(): void {
    for (const end of this.ends) end();
    this.plot.destroy();
  }

  private build(): uPlot {
    const [across, up] = axes({ quantity: FORCE, timeLabels: true });
    const values: uPlot.Axis["values"] = (_, marks, __, ___, step) =>
      axisFigures(LENGTH, marks, step).map((mark) => `${mark}\u00a0mm`);
    return new uPlot(
      {
        width: this.host.clientWidth,
        height: this.host.clientHeight,
        legend: { show: false },
        cursor: { show: false },
        padding: padding(),
        scales: SCALES,
        axes: [{ ...across, values }, up!],
        series: [{}, { auto: false }],
        hooks: { draw: [(plot) => this.path(plot)] },
      },
      [[], []],
      this.host,
    );
  }

  private path(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const [x, y] = [
      (value: number): number => plot.valToPos(value, "x", true),
      (value: number): number => plot.valToPos(value, "y", true),
    ];
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = colour("--measured");
    ctx.lineWidth = 1.25 * devicePixelRatio;
    ctx.beginPath();
    const points = this.boxes.every((box) => box.x[0] === box.x[1] && box.y[0] === box.y[1]);
    for (const [i, box] of this.boxes.entries()) {
      const [left, top] = [x(box.x[0]), y(box.y[1])];
      if (points && i === 0) ctx.moveTo(left, top);
      else if (points) ctx.lineTo(left, top);
      else ctx.rect(left, top, Math.max(1, x(box.x[1]) - left), Math.max(1, y(box.y[0]) - top));
    }
    ctx.globalAlpha = points ? 1 : 0.35;
    if (points) ctx.stroke();
    else ctx.fill();
    ctx.restore();
  }

  private rebuild(): void {
    this.plot.destroy();
    this.plot = this.build();
    this.show(this.boxes);
  }
}
