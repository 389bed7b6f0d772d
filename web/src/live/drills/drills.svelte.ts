// The drills: what can be given, the one that is looked at, and those that were given. Read again while somebody looks.

import { authority } from "../authority/authority.svelte";
import { textOf } from "../messages.svelte";
import { merged } from "../paging";
import { clearDrills, getRecord, giveDrill, listDrills, listRecords } from "./requests";
import type { Catalogue, DrillDetail, DrillSummary } from "./types";

const EVERY_MS = 1000;

export class Drills {
  catalogue = $state.raw<Catalogue | null>(null);
  records = $state.raw<readonly DrillSummary[] | null>(null);
  next = $state.raw<number | null>(null);
  /** The record that is shown. */
  record = $state.raw<DrillDetail | null>(null);
  failure = $state("");
  /** Why the last drill was not given, or its faults not taken back. */
  refusal = $state("");
  busy = $state(false);

  /** Reads as long as the page is visible. @returns a function that ends it. */
  start(): () => void {
    void this.refresh();
    const timer = window.setInterval(() => {
      if (document.visibilityState === "visible") void this.refresh();
    }, EVERY_MS);
    return () => window.clearInterval(timer);
  }

  async refresh(): Promise<void> {
    try {
      const [catalogue, page] = await Promise.all([listDrills(), listRecords(null)]);
      this.catalogue = catalogue;
      const all = merged(this.records, this.next, { list: page.records, next: page.next });
      this.records = all.list;
      this.next = all.next;
      this.failure = "";
      await this.follow();
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  /** The drill under way is shown until it is scored; without one, the last that was given. */
  private async follow(): Promise<void> {
    const shown = this.record?.id ?? this.records?.[0]?.id;
    if (shown === undefined || (this.record !== null && this.record.state !== "under_way")) return;
    await this.show(shown);
  }

  async show(id: number): Promise<void> {
    try {
      this.record = await getRecord(id);
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  async more(): Promise<void> {
    if (this.next === null) return;
    try {
      const page = await listRecords(this.next);
      this.records = [...(this.records ?? []), ...page.records];
      this.next = page.next;
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  give(fault: string, amount: number): Promise<void> {
    return this.attempt(async () => {
      this.record = await giveDrill(fault, amount, authority.epoch);
    });
  }

  clear(): Promise<void> {
    return this.attempt(async () => {
      this.catalogue = await clearDrills(authority.epoch);
    });
  }

  private async attempt(act: () => Promise<void>): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    this.refusal = "";
    try {
      await act();
      await this.refresh();
    } catch (error) {
      this.refusal = textOf(error);
    }
    this.busy = false;
  }
}
