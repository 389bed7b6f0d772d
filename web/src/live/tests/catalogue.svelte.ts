// The library of tests as a list, and what of it one looks at.

import { textOf } from "../messages.svelte";
import { listCatalogue } from "./requests";
import { filtered, tagsOf } from "./search";
import type { CatalogueEntry } from "./types";

class Catalogue {
  list = $state.raw<readonly CatalogueEntry[] | null>(null);
  failure = $state("");
  search = $state("");
  tag = $state("");
  archived = $state(false);
  private asked = 0;

  readonly shown = $derived(filtered(this.list ?? [], this.search, this.tag));
  readonly tags = $derived(tagsOf(this.list ?? []));

  async load(): Promise<void> {
    const asked = ++this.asked;
    try {
      const list = await listCatalogue(this.archived);
      if (asked !== this.asked) return;
      this.list = list;
      this.failure = "";
    } catch (error) {
      if (asked === this.asked) this.failure = textOf(error);
    }
  }
}

export const catalogue = new Catalogue();
