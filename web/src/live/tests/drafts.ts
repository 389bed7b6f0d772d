// What a person has not saved yet, kept in this browser so that nothing is lost on a reload.

import type { Definition } from "./types";

export interface Draft {
  /** The revision that was edited; null for a test that is new. */
  readonly basedOn: number | null;
  readonly name: string;
  readonly yaml: string;
  readonly definition: Definition;
  /** Which of both was written by the person. */
  readonly from: "form" | "yaml";
  readonly keptAt: string;
}

type Store = Pick<Storage, "getItem" | "setItem" | "removeItem" | "key" | "length">;

const PREFIX = "forcerig.draft:";
const keyOf = (id: string | null): string => PREFIX + (id ?? "");

/** Keeps a draft. @returns whether the browser had room for it. */
export function keepDraft(store: Store, id: string | null, draft: Draft): boolean {
  try {
    store.setItem(keyOf(id), JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

/** The draft of a test; null where there is none, or none that can be read. */
export function keptDraft(store: Store, id: string | null): Draft | null {
  try {
    const draft = JSON.parse(store.getItem(keyOf(id)) ?? "null") as Draft | null;
    return draft !== null && typeof draft.yaml === "string" && typeof draft.definition === "object"
      ? draft
      : null;
  } catch {
    return null;
  }
}

export const dropDraft = (store: Store, id: string | null): void => store.removeItem(keyOf(id));

/** Ids of all tests that have a draft; null for the new one. */
export function draftIds(store: Store): (string | null)[] {
  const keys = Array.from({ length: store.length }, (_, i) => store.key(i) ?? "");
  return keys.filter((key) => key.startsWith(PREFIX)).map((key) => key.slice(PREFIX.length) || null);
}
