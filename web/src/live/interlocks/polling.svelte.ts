// What the detectors see, asked for four times a second while somebody looks. One question at a time.

import { textOf } from "../messages.svelte";
import { liveInterlocks } from "./requests";
import type { LiveDetector } from "./types";

const EVERY_MS = 250;
const OLD_MS = 1000;
const WAIT_MS = 3000;

export class Polling {
  list = $state.raw<readonly LiveDetector[]>([]);
  failure = $state("");
  /** The last answer is older than a second: it says nothing of now. */
  old = $state(true);
  private answered_ms = -Infinity;

  /** Asks as long as the page is visible. @returns a function that ends it. */
  start(): () => void {
    let ended = false;
    const rest = (pause_ms: number): Promise<void> => new Promise((done) => window.setTimeout(done, pause_ms));
    const go = async (): Promise<void> => {
      while (!ended) {
        const asked_ms = performance.now();
        if (document.visibilityState === "visible") await this.ask();
        const spent_ms = performance.now() - asked_ms;
        await rest(Math.max(EVERY_MS - spent_ms, spent_ms)); // a slow server is given time
      }
    };
    const watch = window.setInterval(() => (this.old = performance.now() - this.answered_ms > OLD_MS), EVERY_MS);
    void go();
    return () => {
      ended = true;
      window.clearInterval(watch);
    };
  }

  private async ask(): Promise<void> {
    try {
      this.list = (await liveInterlocks(AbortSignal.timeout(WAIT_MS))).detectors;
      this.answered_ms = performance.now();
      this.old = false;
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }
}
