// Filters of the audit, and what an entry changed. Pure.

import { changesBetween } from "../tests/difference";
import { isBranch, type Json } from "../tests/tree";
import type { AuditEntry } from "./types";

export interface AuditFilters {
  readonly who: string;
  readonly action: string;
  readonly target: string;
  readonly search: string;
  /** Days on the reader's own clock, `2024-11-22`; both are within. */
  readonly from: string;
  readonly to: string;
}

export const NO_FILTERS: AuditFilters = { who: "", action: "", target: "", search: "", from: "", to: "" };
const PAGE = 50;

export const isFiltered = (filters: AuditFilters): boolean =>
  Object.values(filters).some((value) => value !== "");

/** The query of the request: only what is asked for. */
export function auditQuery(filters: AuditFilters): string {
  const query = new URLSearchParams({ limit: String(PAGE) });
  for (const name of ["who", "action", "target", "search"] as const)
    if (filters[name].trim() !== "") query.set(name, filters[name].trim());
  if (filters.from !== "") query.set("since", dayStart(filters.from, 0));
  if (filters.to !== "") query.set("until", dayStart(filters.to, 1));
  return query.toString();
}

function dayStart(day: string, later: number): string {
  const [year, month, date] = day.split("-").map(Number) as [number, number, number];
  return new Date(year, month - 1, date + later).toISOString();
}

export interface AuditChange {
  readonly path: string;
  readonly before: string;
  readonly after: string;
}

const NONE = "—";

/** What an entry changed, key by key; what was only made or only removed has one side. */
export function auditChanges({ before, after }: Pick<AuditEntry, "before" | "after">): AuditChange[] {
  const [was, is] = [(before ?? null) as Json, (after ?? null) as Json];
  if (was === null && is === null) return [];
  const from = was === null && isBranch(is) ? {} : was;
  const to = is === null && isBranch(was) ? {} : is;
  return changesBetween(from, to).flatMap((change) =>
    leaves(change.path, change.before as Json | undefined, change.after as Json | undefined),
  );
}

/** A change of a whole branch, leaf by leaf: nobody reads JSON on one line. */
function leaves(path: string, before: Json | undefined, after: Json | undefined): AuditChange[] {
  const whole = isBranch(before) ? before : isBranch(after) ? after : null;
  if (whole === null || (isBranch(before) && isBranch(after)))
    return [{ path, before: said(before), after: said(after) }];
  const keys = Object.keys(whole);
  if (keys.length === 0) return [{ path, before: said(before), after: said(after) }];
  return keys.flatMap((key) => {
    const here = Array.isArray(whole) ? `${path}[${key}]` : path === "" ? key : `${path}.${key}`;
    const inner = (side: Json | undefined): Json | undefined =>
      isBranch(side) ? (side as unknown as Record<string, Json>)[key] : undefined;
    return leaves(here, inner(before), inner(after));
  });
}

function said(value: Json | undefined): string {
  if (value === undefined || value === null) return NONE;
  if (typeof value === "string") return value === "" ? "(empty)" : value;
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}
