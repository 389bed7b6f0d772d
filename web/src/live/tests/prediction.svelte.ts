// The prediction of the test that is being written, as it is written: saved or not.

import { textOf } from "../messages.svelte";
import { answered, ASKED, askAgainAfter_s, NONE, type Predicting } from "../predicting";
import { predict } from "./requests";

const pause = (seconds: number): Promise<void> => new Promise((done) => window.setTimeout(done, 1000 * seconds));

export class DraftPrediction {
  state = $state.raw<Predicting>(NONE);
  /** The text that it is of. */
  of = $state.raw("");
  private asked: AbortController | null = null;

  ask(yaml: string, saved: { readonly id: string; readonly revision: number } | null): void {
    this.close();
    this.asked = new AbortController();
    this.of = yaml;
    this.state = ASKED;
    void this.follow(saved ?? { yaml }, this.asked.signal);
  }

  close(): void {
    this.asked?.abort();
  }

  private async follow(asked: Parameters<typeof predict>[0], signal: AbortSignal): Promise<void> {
    while (!signal.aborted) {
      try {
        const answer = await predict(asked, signal);
        if (!signal.aborted) this.state = answered(this.state, answer);
      } catch (error) {
        if (!signal.aborted) this.state = { is: "failed", why: textOf(error), final: false };
      }
      if (this.state.is !== "computing") return;
      await pause(askAgainAfter_s(this.state));
    }
  }
}
