// Settings that nobody has put in force yet, kept in this browser so that nothing is lost on a reload.

import type { Settings } from "./types";

interface Kept {
  /** The revision that they were made from. */
  readonly basedOn: number;
  readonly settings: Settings;
}

type Store = Pick<Storage, "getItem" | "setItem" | "removeItem">;
const KEY = "forcerig.controller-draft";

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
    return draft !== null && typeof draft.settings?.compensator === "object" && typeof draft.basedOn === "number" ? draft : null;
  } catch {
    return null;
  }
}
