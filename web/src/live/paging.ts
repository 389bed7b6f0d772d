// Pages of the book put together. Pure.

import type { Run, RunPage } from "./types";

export interface Listed {
  readonly list: readonly Run[];
  readonly next: number | null;
}

/** The newest page over what is listed already: pages that were opened below it stay open. */
export function merged(listed: readonly Run[] | null, next: number | null, page: RunPage): Listed {
  const oldest = page.runs.at(-1)?.id;
  if (listed === null || page.next === null || oldest === undefined) return { list: page.runs, next: page.next };
  const overlap = listed.some((run) => run.id === oldest);
  const older = overlap ? listed.filter((run) => run.id < oldest) : [];
  return older.length === 0
    ? { list: page.runs, next: page.next }
    : { list: [...page.runs, ...older], next };
}
