// The tests that can be chosen, and the one that is. The choice is not remembered over a reload on purpose:
// what Start will run is what a person chose in this window.

import { listTests } from "./api";
import { textOf } from "./messages.svelte";
import type { TestSummary } from "./types";

class Tests {
  list = $state.raw<readonly TestSummary[] | null>(null);
  chosenId = $state<string | null>(null);
  failure = $state("");

  readonly chosen = $derived(this.list?.find((test) => test.id === this.chosenId) ?? null);

  async load(): Promise<void> {
    try {
      this.list = await listTests();
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }
}

export const tests = new Tests();
