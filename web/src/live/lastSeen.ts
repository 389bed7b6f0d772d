// How a run was seen last, kept in this browser: it is opened again like that. Pure, but for the storage it is given.

const KEY = "forcerig.runs-seen";
const KEPT = 50;

type Store = Pick<Storage, "getItem" | "setItem">;
type Seen = readonly (readonly [number, string])[];

function read(store: Store): Seen {
  try {
    const found: unknown = JSON.parse(store.getItem(KEY) ?? "[]");
    return Array.isArray(found) ? found.filter((pair) => Array.isArray(pair) && pair.length === 2) : [];
  } catch {
    return [];
  }
}

/** The address under which a run was seen last; empty where it was not. */
export function lastSeen(store: Store, run: number): string {
  const query = read(store).find(([id]) => id === run)?.[1];
  return typeof query === "string" ? query : "";
}

/** Keeps how a run is seen now; the oldest are forgotten. */
export function remember(store: Store, run: number, query: string): void {
  const others = read(store).filter(([id]) => id !== run);
  const kept = query === "" ? others : [[run, query] as const, ...others];
  try {
    store.setItem(KEY, JSON.stringify(kept.slice(0, KEPT)));
  } catch {
    // a full or forbidden storage takes nothing away from the page
  }
}
