// Which runs are listed: a search and filters, in the address so that a view can be shared. Pure.

export interface Filters {
  readonly search: string;
  readonly test_id: string;
  readonly tag: string;
  readonly outcome: string;
  readonly verdict: string;
  readonly operator: string;
  /** Days on the reader's own calendar, `2026-11-22`; both are included. */
  readonly since: string;
  readonly until: string;
}

export const NO_FILTERS: Filters = {
  search: "",
  test_id: "",
  tag: "",
  outcome: "",
  verdict: "",
  operator: "",
  since: "",
  until: "",
};
const NAMES = Object.keys(NO_FILTERS) as readonly (keyof Filters)[];
const DAY = /^\d{4}-\d{2}-\d{2}$/;

/** The filters that an address means; what is no filter, or no day, is left out. */
export function filtersOf(query: string): Filters {
  const asked = new URLSearchParams(query);
  const filters = Object.fromEntries(NAMES.map((name) => [name, asked.get(name) ?? ""])) as unknown as Filters;
  return { ...filters, since: day(filters.since), until: day(filters.until) };
}

const day = (text: string): string =>
  DAY.test(text) && !Number.isNaN(Date.parse(`${text}T00:00`)) ? text : "";

/** The address of these filters: only those that are set, always in one order. */
export function queryOf(filters: Filters): string {
  const set = NAMES.filter((name) => filters[name].trim() !== "").map((name) => [name, filters[name].trim()]);
  return new URLSearchParams(set).toString();
}

/** What the server is asked: days become moments, from the first of one to the end of the other. */
export function apiQuery(filters: Filters): string {
  const query = new URLSearchParams(queryOf(filters));
  if (filters.since) query.set("since", moment(filters.since, 0));
  if (filters.until) query.set("until", moment(filters.until, 1));
  return query.toString();
}

function moment(text: string, daysLater: number): string {
  const at = new Date(`${text}T00:00`);
  at.setDate(at.getDate() + daysLater);
  return at.toISOString();
}

/** How many filters there are beside the search. */
export const filterCount = (filters: Filters): number =>
  NAMES.filter((name) => name !== "search" && filters[name] !== "").length;

export const isFiltered = (filters: Filters): boolean => queryOf(filters) !== "";
