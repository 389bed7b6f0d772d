// Finding a test among many: by words, by tag, the lately run ones on top. Pure.

import type { TestSummary } from "./types";

export interface Choice {
  readonly search: string;
  readonly tag: string | null;
}

const RECENT = 4;

/** Tests that have every word of the search somewhere, and the tag; those archived are never offered. */
export function matching(tests: readonly TestSummary[], { search, tag }: Choice): readonly TestSummary[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  return tests.filter((test) => {
    if (test.archived || (tag !== null && !test.tags.includes(tag))) return false;
    const text = [test.name, test.id, test.description, ...test.tags].join(" ").toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

/** The few that ran last, newest first; then all others by name. */
export function ordered(tests: readonly TestSummary[]): { recent: readonly TestSummary[]; others: readonly TestSummary[] } {
  const ran = tests.filter((test) => test.last_run_at).sort((a, b) => (a.last_run_at! < b.last_run_at! ? 1 : -1));
  const recent = ran.slice(0, RECENT);
  const others = tests
    .filter((test) => !recent.includes(test))
    .sort((a, b) => a.name.localeCompare(b.name, undefined, { numeric: true }));
  return { recent, others };
}

/** Every tag once, in order. */
export const tagsOf = (tests: readonly TestSummary[]): readonly string[] =>
  [...new Set(tests.filter((test) => !test.archived).flatMap((test) => test.tags))].sort();

/** Tags as one types them: separated by commas, each once, in order. */
export function tagsIn(text: string): string[] {
  const tags = text.split(",").map((tag) => tag.trim().replace(/\s+/g, " "));
  return [...new Set(tags.filter((tag) => tag !== ""))].sort();
}
