// The prediction of the chosen test: asked for at once, joined while it is computed, latest wins.

import { post, Problem, request } from "./api";
import { textOf } from "./messages.svelte";
import { answered, ASKED, askAgainAfter_s, gateOf, NONE, type Predicting } from "./predicting";
import type { Computing, Prediction } from "./types";

/** How long one request waits for the answer before the page shows progress, s. */
const PATIENCE_S = 1;
const SETTLE_S = 0.2;

const pause = (seconds: number): Promise<void> => new Promise((done) => window.setTimeout(done, 1000 * seconds));

class Predictor {
  state = $state.raw<Predicting>(NONE);
  readonly gate = $derived(gateOf(this.state));
  readonly prediction = $derived(this.state.is === "done" ? this.state.prediction : null);
  private asked: AbortController | null = null;
  private last: readonly [string | null, number | undefined] = [null, undefined];

  /** Predicts a test, instead of the one before; null: none. */
  of(testId: string | null, revision: number | undefined): void {
    this.last = [testId, revision];
    this.asked?.abort();
    this.asked = null;
    this.state = testId === null ? NONE : ASKED;
    if (testId === null) return;
    this.asked = new AbortController();
    void this.follow(testId, revision, this.asked.signal);
  }

  again(): void {
    this.of(...this.last);
  }

  private async follow(testId: string, revision: number | undefined, signal: AbortSignal): Promise<void> {
    await pause(SETTLE_S); // whoever walks through the list with the arrow keys asks for the last one only
    const path = `tests/${encodeURIComponent(testId)}/prediction`;
    const body = { wait_s: PATIENCE_S, ...(revision === undefined ? {} : { revision }) };
    while (!signal.aborted) {
      try {
        const answer = await request<Prediction | Computing>(path, { ...post(body), signal });
        if (signal.aborted) return;
        this.state = answered(this.state, answer);
      } catch (error) {
        if (signal.aborted) return;
        this.state = { is: "failed", why: textOf(error), final: isFinal(error) };
      }
      if (this.state.is !== "computing") return;
      await pause(askAgainAfter_s(this.state));
    }
  }
}

/** A test that the server understood and refused will not start either. */
function isFinal(error: unknown): boolean {
  return error instanceof Problem && error.status === 422;
}

export const predictor = new Predictor();
