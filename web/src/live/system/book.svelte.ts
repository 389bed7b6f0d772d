// The audit as it is listed: newest first, page by page. The newest question counts.

import { textOf } from "../messages.svelte";
import { listAudit } from "./requests";
import type { AuditEntry } from "./types";

const TYPING_MS = 200;

export class AuditBook {
  entries = $state.raw<readonly AuditEntry[]>([]);
  next = $state.raw<number | null>(null);
  failure = $state("");
  busy = $state(true);
  private query = "";
  private serial = 0;
  private timer = 0;

  /** Lists what a query finds, a moment after the last key. */
  read(query: string): void {
    this.query = query;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.page(null), TYPING_MS);
  }

  more(): Promise<void> {
    return this.page(this.next);
  }

  private async page(before: number | null): Promise<void> {
    const serial = ++this.serial;
    this.busy = true;
    try {
      const { entries, next } = await listAudit(this.query, before);
      if (serial !== this.serial) return;
      this.entries = before === null ? entries : [...this.entries, ...entries];
      this.next = next;
      this.failure = "";
    } catch (error) {
      if (serial !== this.serial) return;
      this.failure = textOf(error);
    }
    this.busy = false;
  }
}
