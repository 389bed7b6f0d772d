// The list of runs, newest first, page by page. Read again whenever the server says that it changed.

import { listRuns } from "./api";
import { textOf } from "./messages.svelte";
import type { Run } from "./types";

class Runs {
  list = $state.raw<readonly Run[] | null>(null);
  next = $state.raw<number | null>(null);
  failure = $state("");
  busy = $state(false);
  private asked = 0;

  /** Reads the newest page again; older pages that were opened stay. */
  async refresh(): Promise<void> {
    const asked = ++this.asked;
    try {
      const page = await listRuns(null);
      if (asked !== this.asked) return;
      const oldest = page.runs.at(-1)?.id ?? 0;
      const older = page.next === null ? [] : (this.list ?? []).filter((run) => run.id < oldest);
      this.list = [...page.runs, ...older];
      if (older.length === 0) this.next = page.next;
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  async more(): Promise<void> {
    if (this.next === null || this.busy) return;
    this.busy = true;
    try {
      const page = await listRuns(this.next);
      this.list = [...(this.list ?? []), ...page.runs];
      this.next = page.next;
    } catch (error) {
      this.failure = textOf(error);
    } finally {
      this.busy = false;
    }
  }
}

export const runs = new Runs();
