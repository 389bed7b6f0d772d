// uPlot's options shared by live charts and run charts: axes in display units, colours of the theme.

import type uPlot from "uplot";
import { axisFigures, TIME, type Quantity } from "../units";
import { colour } from "./colours";

/** Size of axis labels in CSS pixels, following the root font size: a wall screen has a larger one. */
export const fontSize = (): number => 0.78 * parseFloat(getComputedStyle(document.documentElement).fontSize);

const keep: uPlot.Range.Function = (_, min, max) => [min, max];

/** Linear scales that never choose a range of their own: whoever draws says what is shown. */
export const SCALES: uPlot.Scales = {
  x: { time: false, auto: false, range: keep },
  y: { auto: false, range: keep },
};

/** Top, right, bottom, left: room for half a label, no more. */
export function padding(): [number, number, number, number] {
  const size = fontSize();
  return [Math.round(0.6 * size), Math.round(2.4 * size), Math.round(0.6 * size), 0];
}

interface AxesOptions {
  readonly quantity: Quantity;
  /** Whether the time axis has labels, or only its grid. */
  readonly timeLabels: boolean;
}

/** Time below, the quantity at the left. The left axis has one width everywhere, so that charts line up. */
export function axes({ quantity, timeLabels }: AxesOptions): uPlot.Axis[] {
  const size = fontSize();
  const font = `${size.toFixed(1)}px ${colour("--font")}`;
  const common = {
    font,
    stroke: () => colour("--ink-2"),
    grid: { stroke: () => colour("--grid"), width: 1 },
    ticks: { stroke: () => colour("--grid"), width: 1, size: 4 },
  };
  return [
    {
      ...common,
      space: 6 * size,
      size: timeLabels ? Math.round(1.9 * size) : 4,
      gap: 2,
      values: (_, marks, __, ___, step) =>
        timeLabels ? axisFigures(TIME, marks, step).map((mark) => `${mark}\u00a0s`) : marks.map(() => ""),
    },
    {
      ...common,
      space: 2.4 * size,
      size: Math.round(4.6 * size),
      gap: 4,
      values: (_, marks, __, ___, step) => axisFigures(quantity, marks, step),
    },
  ];
}

/** A line of constant width; the colour follows the theme. */
export function line(label: string, cssVariable: string, width: number): uPlot.Series {
  return {
    label,
    width,
    stroke: () => colour(cssVariable),
    points: { show: false },
    spanGaps: false,
    auto: false,
  };
}
