// What a person writes into the book with the next run: operator, notes, tags, and the reason for an override.

import { tagsIn } from "./choosing";
import { isReason } from "./predicting";

const OPERATOR = "forcerig.operator";

export interface RunEntry {
  readonly operator?: string;
  readonly notes?: string;
  readonly tags?: readonly string[];
  readonly override_reason?: string;
}

class Entry {
  operator = $state(localStorage.getItem(OPERATOR) ?? "");
  notes = $state("");
  tags = $state("");
  reason = $state("");
  /** A revision that is to run again, where it is not the newest of its test. */
  again = $state.raw<{ readonly testId: string; readonly revision: number } | null>(null);
  /** The reason is asked for, beside Start. */
  asking = $state(false);
  readonly hasReason = $derived(isReason(this.reason));

  /** Which revision of a test Start will run: the newest, unless an older one is to run again. */
  revisionOf({ id, revision }: { readonly id: string; readonly revision: number }): number {
    return this.again?.testId === id ? this.again.revision : revision;
  }

  keepOperator(): void {
    localStorage.setItem(OPERATOR, this.operator.trim());
  }

  /** What goes with the start; nothing where nothing was written. */
  body(overriding: boolean): RunEntry {
    const tags = tagsIn(this.tags);
    return {
      ...(this.operator.trim() === "" ? {} : { operator: this.operator.trim() }),
      ...(this.notes.trim() === "" ? {} : { notes: this.notes.trim() }),
      ...(tags.length === 0 ? {} : { tags }),
      ...(overriding ? { override_reason: this.reason.trim() } : {}),
    };
  }

  /** After a start: operator and tags stay for the next run, notes and reason were about this one. */
  started(): void {
    this.notes = "";
    this.forgetReason();
  }

  forgetReason(): void {
    this.reason = "";
    this.asking = false;
  }
}

export const entry = new Entry();
