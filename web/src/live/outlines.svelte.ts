// The blocks of the run under way, from what was frozen with it: whoever started it, and whatever became of the test.

import { getRun, post, request } from "./api";
import type { BlockSpan } from "./progress";

interface Checked {
  readonly outline: { readonly blocks: readonly BlockSpan[] } | null;
}

class RunBlocks {
  /** Empty where they are not known. */
  blocks = $state.raw<readonly BlockSpan[]>([]);
  private of: number | null = null;

  async follow(run: number | null): Promise<void> {
    if (run === this.of) return;
    this.of = run;
    this.blocks = [];
    if (run === null) return;
    try {
      const { definition } = await getRun(run);
      const { outline } = await request<Checked>("tests/check", post({ definition }));
      if (run === this.of) this.blocks = outline?.blocks ?? [];
    } catch {
      // a progress bar without its blocks is still a progress bar
    }
  }
}

export const runBlocks = new RunBlocks();
