// Lost ticks, shown as what they are even where they are narrower than a pixel.

import type uPlot from "uplot";
import type { SampleRing } from "../live/ring";
import { colour } from "./colours";

const LEAST_PX = 2;
const EDGE_PX = 4;

/** Shades every gap of the ring that lies in view; x is in seconds before the newest sample. */
export function shadeGaps(plot: uPlot, ring: SampleRing, period_s: number): void {
  if (ring.gaps.length === 0) return;
  const { left, top, width, height } = plot.bbox;
  const newest = ring.endTick - 1;
  plot.ctx.save();
  for (const gap of ring.gaps) {
    const from = plot.valToPos((gap.fromTick - newest) * period_s, "x", true);
    const to = plot.valToPos((gap.toTick - newest) * period_s, "x", true);
    const x = Math.max(left, from);
    const end = Math.min(left + width, Math.max(to, from + LEAST_PX));
    if (end <= x) continue;
    plot.ctx.fillStyle = colour("--gap");
    plot.ctx.fillRect(x, top, end - x, height);
    plot.ctx.fillStyle = colour("--gap-edge");
    plot.ctx.fillRect(x, top, end - x, EDGE_PX);
  }
  plot.ctx.restore();
}
