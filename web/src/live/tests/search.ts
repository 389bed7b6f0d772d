// Finding a test among the tests that are there: every word must be found somewhere.

import type { CatalogueEntry } from "./types";

const plain = (text: string): string => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();

/** The tests that have every word of `search` in name, id, description or tags, and the tag if there is one. */
export function filtered(list: readonly CatalogueEntry[], search: string, tag: string): CatalogueEntry[] {
  const words = plain(search).split(/\s+/).filter((word) => word !== "");
  return list.filter((test) => {
    if (tag !== "" && !test.tags.includes(tag)) return false;
    const text = plain([test.name, test.id, test.description, ...test.tags].join(" "));
    return words.every((word) => text.includes(word));
  });
}

/** Every tag, once, in order. */
export const tagsOf = (list: readonly CatalogueEntry[]): string[] =>
  [...new Set(list.flatMap((test) => test.tags))].sort((a, b) => a.localeCompare(b));

/** Tags as typed: separated by commas, each once. */
export const tagsIn = (text: string): string[] => [
  ...new Set(text.split(",").map((tag) => tag.trim()).filter((tag) => tag !== "")),
];
