// Pages of a list put together. Pure.

export interface Listed<Entry> {
  readonly list: readonly Entry[];
  /** The id to ask for those before. */
  readonly next: number | null;
}

/** The newest page over what is listed already: pages that were opened below it stay open. */
export function merged<Entry extends { readonly id: number }>(
  listed: readonly Entry[] | null,
  next: number | null,
  page: Listed<Entry>,
): Listed<Entry> {
  const oldest = page.list.at(-1)?.id;
  if (listed === null || page.next === null || oldest === undefined) return page;
  const overlap = listed.some((entry) => entry.id === oldest);
  const older = overlap ? listed.filter((entry) => entry.id < oldest) : [];
  return older.length === 0 ? page : { list: [...page.list, ...older], next };
}
