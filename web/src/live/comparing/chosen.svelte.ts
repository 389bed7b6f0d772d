// The runs that were chosen in the book to be compared: in the order in which they were, the baseline first.

import { MOST_RUNS } from "./query";

class Chosen {
  ids = $state.raw<readonly number[]>([]);
  readonly full = $derived(this.ids.length >= MOST_RUNS);

  toggle(id: number): void {
    if (this.ids.includes(id)) this.ids = this.ids.filter((other) => other !== id);
    else if (!this.full) this.ids = [...this.ids, id];
  }

  clear(): void {
    this.ids = [];
  }
}

export const chosen = new Chosen();
