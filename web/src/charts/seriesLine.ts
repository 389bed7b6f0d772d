// Lines of several runs in one chart: six colours that colour-blind people tell apart, then the same ones dashed.

import { seriesColour } from "./seriesLook";

const COLOURS = 6;
const DASH: readonly number[] = [7, 4];

export interface SeriesLine {
  /** A CSS variable of the theme. */
  readonly colour: string;
  /** Empty for a solid line. */
  readonly dash: readonly number[];
}

/** The line of a run, by its place in the comparison. */
export const lineOf = (index: number): SeriesLine => ({
  colour: seriesColour(index),
  dash: index < COLOURS ? [] : DASH,
});
