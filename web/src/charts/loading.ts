// Samples of a run come progressively: what is there is shown until what is finer arrives; latest wins. Pure.

import type { RunSamples } from "../live/types";
import { shownWindow, type TimeWindow, type ZoomStack } from "./zoom";

export interface Request {
  readonly from_s: number;
  readonly to_s: number;
  readonly points: number;
  /** Which channels: samples of other ones are no use. */
  readonly key: string;
}

export interface Loaded {
  readonly request: Request;
  readonly samples: RunSamples;
}

export interface Loading {
  /** The whole run, coarsely: under everything. */
  readonly overview: Loaded | null;
  readonly fine: Loaded | null;
  readonly inFlight: Request | null;
  /** What is wanted once the answer under way is there. */
  readonly next: Request | null;
}

export const EMPTY: Loading = { overview: null, fine: null, inFlight: null, next: null };

/** As much again on both sides, so that a small move shows what is there already. */
const MARGIN = 0.5;

/** What to ask for, for this window: with room on both sides, and as many points as the screen has in it. */
export function requestFor(stack: ZoomStack, points: number, key: string): Request {
  const { from_s, to_s } = shownWindow(stack);
  const [run] = stack as [TimeWindow];
  const width = to_s - from_s;
  const from = Math.max(run.from_s, from_s - MARGIN * width);
  const to = Math.min(run.to_s, to_s + MARGIN * width);
  return { from_s: from, to_s: to, points: Math.round((points * (to - from)) / width), key };
}

const density = ({ from_s, to_s, points }: Request): number => points / (to_s - from_s);
const covers = (outer: TimeWindow, inner: TimeWindow): boolean =>
  outer.from_s <= inner.from_s + 1e-9 && outer.to_s >= inner.to_s - 1e-9;
const touches = (a: TimeWindow, b: TimeWindow): boolean => a.from_s < b.to_s && b.from_s < a.to_s;

/** Whether this is as good as it gets for the window: all of it, at the wanted density or tick by tick. */
function suffices(loaded: Loaded | null, window: TimeWindow, wanted: Request): boolean {
  if (loaded === null || loaded.request.key !== wanted.key || !covers(loaded.request, window)) return false;
  return !loaded.samples.decimated || density(loaded.request) >= 0.75 * density(wanted);
}

/** Something else is looked at. `inFlight` of the result is what must be under way; another one is given up. */
export function looked(state: Loading, stack: ZoomStack, points: number, key: string): Loading {
  const window = shownWindow(stack);
  const wanted = requestFor(stack, points, key);
  const of = (loaded: Loaded | null): Loaded | null => (loaded?.request.key === key ? loaded : null);
  const kept = { ...state, overview: of(state.overview), fine: of(state.fine) };
  if (suffices(kept.fine, window, wanted) || suffices(kept.overview, window, wanted)) {
    return { ...kept, next: null };
  }
  const { inFlight } = kept;
  const useful = inFlight !== null && inFlight.key === key && touches(inFlight, window);
  if (!useful) return { ...kept, inFlight: wanted, next: null };
  const enough = covers(inFlight, window) && density(inFlight) >= 0.75 * density(wanted);
  return { ...kept, next: enough ? null : wanted };
}

/** An answer arrived. It is shown if it is of what was last asked for; then the next is under way. */
export function arrived(state: Loading, request: Request, samples: RunSamples, run: TimeWindow): Loading {
  if (request !== state.inFlight) return state;
  const loaded = { request, samples };
  const isWhole = covers(request, run);
  return {
    overview: isWhole ? loaded : state.overview,
    fine: isWhole ? state.fine : loaded,
    inFlight: state.next,
    next: null,
  };
}

/** An answer did not arrive: what is there stays, and nothing is under way. */
export const failed = (state: Loading, request: Request): Loading =>
  request === state.inFlight ? { ...state, inFlight: null, next: null } : state;

/** The best there is to draw: the fine stretch, with the coarse one on both sides of it. */
export function composed({ overview, fine }: Loading, window: TimeWindow): RunSamples | null {
  if (fine === null || !touches(fine.request, window)) return overview?.samples ?? null;
  if (overview === null || covers(fine.request, window)) return fine.samples;
  if (density(overview.request) >= density(fine.request) && fine.samples.decimated) return overview.samples;
  const { from_s, to_s } = fine.request;
  const time = overview.samples.time_s;
  const left = time.findIndex((at) => at >= from_s);
  const right = time.findIndex((at) => at > to_s);
  const before = left < 0 ? time.length : left;
  const after = right < 0 ? time.length : right;
  const join = <T>(coarse: readonly T[], middle: readonly T[]): T[] => [
    ...coarse.slice(0, before),
    ...middle,
    ...coarse.slice(after),
  ];
  const channels = Object.fromEntries(
    Object.entries(fine.samples.channels).map(([name, band]) => {
      const coarse = overview.samples.channels[name];
      return [name, coarse ? { min: join(coarse.min, band.min), max: join(coarse.max, band.max) } : band];
    }),
  );
  const decimated = fine.samples.decimated || overview.samples.decimated;
  return { ...fine.samples, decimated, time_s: join(time, fine.samples.time_s), channels };
}
