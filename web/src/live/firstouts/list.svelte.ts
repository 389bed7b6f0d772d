// The first-outs, newest first. Read again now and then while somebody looks: a black box comes two seconds late.

import { textOf } from "../messages.svelte";
import { merged } from "../paging";
import { listFirstOuts } from "./requests";
import type { FirstOutSummary } from "./types";

const EVERY_MS = 1500;

export class FirstOuts {
  list = $state.raw<readonly FirstOutSummary[] | null>(null);
  next = $state.raw<number | null>(null);
  /** Why one could not be kept yet. */
  trouble = $state.raw<string | null>(null);
  failure = $state("");

  /** Reads as long as the page is visible. @returns a function that ends it. */
  start(): () => void {
    void this.refresh();
    const timer = window.setInterval(() => {
      if (document.visibilityState === "visible") void this.refresh();
    }, EVERY_MS);
    return () => window.clearInterval(timer);
  }

  async refresh(): Promise<void> {
    await this.read(null, (page) => {
      const shown = merged(this.list, this.next, page);
      this.list = shown.list;
      this.next = shown.next;
    });
  }

  async more(): Promise<void> {
    const before = this.next;
    if (before !== null)
      await this.read(before, (page) => {
        this.list = [...(this.list ?? []), ...page.list];
        this.next = page.next;
      });
  }

  private async read(
    before: number | null,
    take: (page: { readonly list: readonly FirstOutSummary[]; readonly next: number | null }) => void,
  ): Promise<void> {
    try {
      const { first_outs, next, trouble } = await listFirstOuts(before);
      take({ list: first_outs, next });
      this.trouble = trouble;
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }
}
