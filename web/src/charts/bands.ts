// The extremes of a recorded run as uPlot takes them: a lower and an upper line per channel.

import type uPlot from "uplot";
import type { RunSamples } from "../live/types";
import { figure, NOTHING, type Quantity } from "../units";
import type { TimeWindow } from "./zoom";

/** x, then minimum and maximum of each channel in turn; a channel that was not recorded is empty. */
export function bandData(samples: RunSamples, channels: readonly string[]): uPlot.AlignedData {
  const missing = (): null[] => samples.time_s.map(() => null);
  const columns = channels.flatMap((channel) => {
    const band = samples.channels[channel];
    return band ? [band.min, band.max] : [missing(), missing()];
  });
  return [samples.time_s, ...columns];
}

const ALWAYS: TimeWindow = { from_s: -Infinity, to_s: Infinity };

/** Lowest and highest value of these channels within a window; NaN where there is none. */
export function bandExtent(
  samples: RunSamples,
  channels: readonly string[],
  { from_s, to_s }: TimeWindow = ALWAYS,
): { low: number; high: number } {
  let low = Infinity;
  let high = -Infinity;
  samples.time_s.forEach((time, i) => {
    if (time < from_s || time > to_s) return;
    for (const channel of channels) {
      const band = samples.channels[channel];
      const [least, most] = [band?.min[i], band?.max[i]];
      if (typeof least === "number" && least < low) low = least;
      if (typeof most === "number" && most > high) high = most;
    }
  });
  return low <= high ? { low, high } : { low: NaN, high: NaN };
}

/** The value of a channel in one column: a figure, or both extremes. */
export function bandFigure(samples: RunSamples, channel: string, at: number, quantity: Quantity): string {
  const band = samples.channels[channel];
  const [low, high] = [band?.min[at], band?.max[at]];
  if (typeof low !== "number" || typeof high !== "number") return NOTHING;
  const text = figure(quantity, low, 1);
  return low === high ? text : `${text} … ${figure(quantity, high, 1)}`;
}

/** The place of the column nearest to a moment; null where there is none. */
export function place({ time_s }: RunSamples, at_s: number): number | null {
  let [low, high] = [0, time_s.length - 1];
  if (high < 0) return null;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time_s[middle]! <= at_s) low = middle;
    else high = middle;
  }
  return Math.abs(time_s[low]! - at_s) <= Math.abs(time_s[high]! - at_s) ? low : high;
}
