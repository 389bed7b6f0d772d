// What is seen of one recording, a run or a black box: the window of time, the channels, and the samples there are for them.

import { textOf } from "../live/messages.svelte";
import type { RunSamples } from "../live/types";
import { arrived, composed, EMPTY, failed, looked, type Loading, type Request } from "./loading";
import { grown, shownWindow, type TimeWindow, type ZoomStack } from "./zoom";

const MOST_POINTS = 20_000;

/** Reads a stretch of a recording: the extremes of at most so many columns, or single ticks where they fit. */
export type ReadSamples = (
  channels: readonly string[],
  from_s: number,
  to_s: number,
  points: number,
  signal: AbortSignal,
) => Promise<RunSamples>;

export class RunView {
  stack: ZoomStack = $state.raw([{ from_s: 0, to_s: 1 }]);
  samples = $state.raw<RunSamples | null>(null);
  busy = $state(false);
  failure = $state("");
  readonly window: TimeWindow = $derived(shownWindow(this.stack));

  private loading: Loading = EMPTY;
  private channels: readonly string[] = [];
  private points = 0;
  private underWay: { request: Request; abort: AbortController } | null = null;

  constructor(
    private readonly read: ReadSamples,
    readonly period_s: number,
    all: TimeWindow,
    window: TimeWindow | null,
  ) {
    this.stack = window === null ? [all] : [all, window];
  }

  look(stack: ZoomStack | null): void {
    if (stack === null || stack === this.stack) return;
    this.stack = stack;
    this.load();
  }

  /** Which channels are drawn, and how many points fit side by side. */
  draw(channels: readonly string[], points: number): void {
    this.channels = [...new Set(channels)];
    this.points = points;
    this.load();
  }

  /** The run goes on: there is more of it. What was read of the whole is read again. */
  grow(duration_s: number): void {
    if (duration_s <= this.stack[0]!.to_s) return;
    this.stack = grown(this.stack, duration_s);
    if (this.stack.length === 1) this.load();
  }

  destroy(): void {
    this.underWay?.abort.abort();
    this.points = 0;
  }

  private load(): void {
    if (this.points === 0 || this.channels.length === 0) return;
    this.take(looked(this.loading, this.stack, Math.min(this.points, MOST_POINTS), this.channels.join()));
  }

  /** Shows what there is now, and asks for what must be under way now. */
  private take(next: Loading): void {
    this.loading = next;
    this.samples = composed(next, this.window) ?? this.samples;
    this.busy = next.inFlight !== null;
    if (next.inFlight === (this.underWay?.request ?? null)) return;
    this.underWay?.abort.abort();
    this.underWay = null;
    if (next.inFlight !== null) void this.ask(next.inFlight);
  }

  private async ask(request: Request): Promise<void> {
    const abort = new AbortController();
    this.underWay = { request, abort };
    const { from_s, to_s, points, key } = request;
    try {
      const samples = await this.read(key.split(","), from_s, to_s, points, abort.signal);
      if (abort.signal.aborted) return;
      this.underWay = null;
      this.failure = "";
      this.take(arrived(this.loading, request, samples, this.stack[0]!));
    } catch (error) {
      if (abort.signal.aborted) return;
      this.underWay = null;
      this.failure = textOf(error);
      this.take(failed(this.loading, request));
    }
  }
}
