// What was predicted of a run, for the stretch that is looked at. Latest wins; what is there stays until then.

import { Problem } from "./api";
import { runPredicted } from "./book";
import { textOf } from "./messages.svelte";
import type { PredictedBands } from "./types";

const SETTLE_MS = 120;

export class ForeseenRun {
  wanted = $state(false);
  bands = $state.raw<PredictedBands | null>(null);
  failure = $state("");
  private asked = new AbortController();
  private timer = 0;
  /** Nothing was kept of this run: asking again does not change that. */
  private none = false;

  constructor(private readonly runId: number) {}

  look({ from_s, to_s }: { from_s: number; to_s: number }, points: number): void {
    window.clearTimeout(this.timer);
    if (this.none) return;
    this.timer = window.setTimeout(() => void this.read(from_s, to_s, points), SETTLE_MS);
  }

  private async read(from_s: number, to_s: number, points: number): Promise<void> {
    this.asked.abort();
    this.asked = new AbortController();
    const { signal } = this.asked;
    try {
      const bands = await runPredicted(this.runId, from_s, to_s, points, signal);
      if (signal.aborted) return;
      this.bands = bands;
      this.failure = "";
    } catch (error) {
      if (signal.aborted) return;
      this.none = error instanceof Problem && error.status === 404;
      this.failure = `No prediction to draw. ${textOf(error)}`;
    }
  }
}
