// A comparison, from asking to the answer: the latest question wins, the picture before it stays until then.

import { textOf } from "../messages.svelte";
import { compareRuns } from "./requests";
import type { Comparison } from "./types";

const AGAIN_MS = 300;

export class Comparing {
  found = $state.raw<Comparison | null>(null);
  failure = $state("");
  busy = $state(false);
  /** Of a comparison that takes long; null where nothing is known of it. */
  share = $state<number | null>(null);
  private asked = "";
  private abort = new AbortController();

  /** Asks, unless that was asked already. */
  ask(asked: string): void {
    if (asked === this.asked) return;
    this.asked = asked;
    this.abort.abort();
    this.abort = new AbortController();
    void this.read(asked, this.abort.signal);
  }

  /** Asks the same once more, after a failure. */
  again(): void {
    const { asked } = this;
    this.asked = "";
    this.ask(asked);
  }

  destroy(): void {
    this.abort.abort();
  }

  private async read(asked: string, signal: AbortSignal): Promise<void> {
    this.busy = true;
    this.share = null;
    try {
      for (;;) {
        const answer = await compareRuns(asked, signal);
        if (signal.aborted) return;
        if (!("state" in answer)) {
          this.found = answer;
          this.failure = "";
          break;
        }
        this.share = answer.share;
        await new Promise((resolve) => window.setTimeout(resolve, AGAIN_MS));
        if (signal.aborted) return;
      }
    } catch (error) {
      if (signal.aborted) return;
      this.failure = textOf(error);
    }
    this.busy = false;
    this.share = null;
  }
}
