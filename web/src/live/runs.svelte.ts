// The book of runs as it is listed: newest first, page by page, filtered. Latest wins; older pages stay opened.

import { apiQuery, NO_FILTERS, type Filters } from "./filters";
import { listRuns } from "./book";
import { merged } from "./paging";
import { textOf } from "./messages.svelte";
import type { Run } from "./types";

const TYPING_S = 0.15;

class Runs {
  list = $state.raw<readonly Run[] | null>(null);
  next = $state.raw<number | null>(null);
  failure = $state("");
  busy = $state(false);
  private filters: Filters = NO_FILTERS;
  private asked = new AbortController();
  private timer = 0;
  /** What is listed was found by the filters of now. */
  private current = false;

  /** Lists other runs, a moment after the last key. */
  filter(filters: Filters): void {
    if (apiQuery(filters) === apiQuery(this.filters) && this.list !== null) return;
    const typed = filters.search !== this.filters.search;
    this.filters = filters;
    this.current = false;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.refresh(), typed ? 1000 * TYPING_S : 0);
  }

  /** Reads the newest page again; older pages that were opened stay. */
  async refresh(): Promise<void> {
    this.asked.abort();
    this.asked = new AbortController();
    const { signal } = this.asked;
    this.busy = true;
    try {
      const page = await listRuns(apiQuery(this.filters), null, signal);
      if (signal.aborted) return;
      const state = merged(this.current ? this.list : null, this.next, { list: page.runs, next: page.next });
      this.list = state.list;
      this.next = state.next;
      this.current = true;
      this.failure = "";
    } catch (error) {
      if (signal.aborted) return;
      this.failure = textOf(error);
    }
    this.busy = false;
  }

  async more(): Promise<void> {
    if (this.next === null || this.busy || !this.current) return;
    this.busy = true;
    const { signal } = this.asked;
    try {
      const page = await listRuns(apiQuery(this.filters), this.next, signal);
      if (signal.aborted) return;
      this.list = [...(this.list ?? []), ...page.runs];
      this.next = page.next;
      this.failure = "";
    } catch (error) {
      if (signal.aborted) return;
      this.failure = textOf(error);
    }
    this.busy = false;
  }

  /** Puts a run that was edited here in its place. */
  replace(run: Run): void {
    this.list = this.list?.map((old) => (old.id === run.id ? { ...old, ...run } : old)) ?? null;
  }
}

export const runs = new Runs();
