// The extremes of a recorded run as uPlot takes them: a lower and an upper line per channel.

import type uPlot from "uplot";
import type { RunSamples } from "../live/types";
import { figure, NOTHING, type Quantity } from "../units";

/** x, then minimum and maximum of each channel in turn; a channel that was not recorded is empty. */
export function bandData(samples: RunSamples, channels: readonly string[]): uPlot.AlignedData {
  const missing = (): null[] => samples.time_s.map(() => null);
  const columns = channels.flatMap((channel) => {
    const band = samples.channels[channel];
    return band ? [band.min, band.max] : [missing(), missing()];
  });
  return [samples.time_s, ...columns];
}

/** Lowest and highest value over these channels; NaN where there is none. */
export function bandExtent(samples: RunSamples, channels: readonly string[]): { low: number; high: number } {
  let low = Infinity;
  let high = -Infinity;
  for (const channel of channels) {
    const band = samples.channels[channel];
    for (const value of band?.min ?? []) if (value !== null && value < low) low = value;
    for (const value of band?.max ?? []) if (value !== null && value > high) high = value;
  }
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
