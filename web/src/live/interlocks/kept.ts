// A table that nobody has saved yet, kept in this browser so that nothing is lost on a reload.

import type { Table } from "./draft";

export interface Kept {
  /** The revision that was edited. */
  readonly basedOn: number;
  readonly detectors: Table;
  readonly keptAt: string;
}

type Store = Pick<Storage, "getItem" | "setItem" | "removeItem">;
const KEY = "forcerig.interlocks-draft";

/** Keeps a draft; a browser without room goes on without. */
export function keep(store: Store, draft: Kept): void {
  try {
    store.setItem(KEY, JSON.stringify(draft));
  } catch {
    // the draft is still on the screen
  }
}

export const drop = (store: Store): void => store.removeItem(KEY);

/** The draft; null where there is none, or none that can be read. */
export function kept(store: Store): Kept | null {
  try {
    const draft = JSON.parse(store.getItem(KEY) ?? "null") as Kept | null;
    return draft !== null && Array.isArray(draft.detectors) && typeof draft.basedOn === "number" ? draft : null;
  } catch {
    return null;
  }
}
