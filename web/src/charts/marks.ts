// Block boundaries and events as they are marked on a chart of a run. Pure, but for the drawing at the end.

import type uPlot from "uplot";
import { colour } from "./colours";
import { fontSize } from "./options";

export interface Mark {
  readonly time_s: number;
  readonly kind: "block" | "trip" | "event";
  readonly label: string;
}

interface Event {
  readonly kind: string;
  readonly code: string;
  readonly time_s: number;
}

const MARKED: ReadonlySet<string> = new Set(["command", "program_ended", "fault", "stop_asked"]);

const SKIP = "skip"; // the console's own, many of them to each frequency response

/** What of a run's events is marked: blocks, trips, and what people did. */
export function marksOf(events: readonly Event[]): readonly Mark[] {
  return events.flatMap(({ kind, code, time_s }): Mark[] => {
    if (kind === "block") return Number(code) >= 0 ? [{ time_s, kind, label: String(Number(code) + 1) }] : [];
    if (kind === "trip") return [{ time_s, kind, label: "" }];
    return MARKED.has(kind) && code !== SKIP ? [{ time_s, kind: "event", label: "" }] : [];
  });
}

/** Marks in view that are far enough apart to be told from each other; a trip is never left out. */
export function legible(
  marks: readonly Mark[],
  xAt: (time_s: number) => number,
  width: number,
  least_px: number,
): readonly { readonly mark: Mark; readonly x: number }[] {
  let last = -Infinity;
  return marks.flatMap((mark) => {
    const x = xAt(mark.time_s);
    if (x < 0 || x > width) return [];
    if (mark.kind !== "trip" && x - last < least_px) return [];
    if (mark.kind === "block") last = x;
    return [{ mark, x }];
  });
}

const COLOURS = { block: "--edge", trip: "--trip", event: "--stale" } as const;

/** Draws the marks over the grid and under the lines. */
export function drawMarks(plot: uPlot, marks: readonly Mark[]): void {
  const { ctx, bbox } = plot;
  const ratio = devicePixelRatio;
  const size = fontSize() * ratio;
  const xAt = (time_s: number): number => plot.valToPos(time_s, "x", true) - bbox.left;
  ctx.save();
  ctx.font = `${size.toFixed(1)}px ${colour("--font")}`;
  ctx.textAlign = "left";
  ctx.textBaseline = "top";
  for (const { mark, x } of legible(marks, xAt, bbox.width, 2 * size)) {
    const left = Math.round(bbox.left + x);
    ctx.strokeStyle = ctx.fillStyle = colour(COLOURS[mark.kind]);
    ctx.lineWidth = mark.kind === "trip" ? 2 * ratio : ratio;
    ctx.setLineDash(mark.kind === "event" ? [3 * ratio, 3 * ratio] : []);
    ctx.beginPath();
    ctx.moveTo(left, bbox.top);
    ctx.lineTo(left, bbox.top + bbox.height);
    ctx.stroke();
    if (mark.label !== "") ctx.fillText(mark.label, left + 0.3 * size, bbox.top + 0.15 * size);
  }
  ctx.restore();
}
