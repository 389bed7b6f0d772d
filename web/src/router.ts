// Pages by the part of the address after `#`: a path and, behind `?`, what is shown there. Pure; App.svelte listens.

export type Route =
  | { readonly page: "operate" }
  | { readonly page: "runs"; readonly query: string }
  | { readonly page: "run"; readonly id: number; readonly query: string }
  | { readonly page: "tests" }
  /** A test of the library; null: one that is being written. */
  | { readonly page: "test"; readonly id: string | null }
  | { readonly page: "interlocks" }
  /** A trip that took the load off, with what was recorded around it. */
  | { readonly page: "first-out"; readonly id: number; readonly query: string }
  /** Several runs side by side: which, and how, is in the query. */
  | { readonly page: "compare"; readonly query: string }
  | { readonly page: "controller" }
  | { readonly page: "rig"; readonly tab: RigTab }
  | { readonly page: "drills" }
  | { readonly page: "system"; readonly tab: SystemTab };

export const SYSTEM_TABS = ["users", "tokens", "audit", "loop", "doctor"] as const;
export type SystemTab = (typeof SYSTEM_TABS)[number];

export const RIG_TABS = ["configuration", "static", "linear", "identification", "view"] as const;
export type RigTab = (typeof RIG_TABS)[number];

export const PAGES = [
  { page: "operate", href: "#/operate", label: "Operate" },
  { page: "tests", href: "#/tests", label: "Tests" },
  { page: "runs", href: "#/runs", label: "Runs" },
  { page: "interlocks", href: "#/interlocks", label: "Interlocks" },
  { page: "controller", href: "#/controller", label: "Controller" },
  { page: "rig", href: "#/rig", label: "Rig" },
  { page: "drills", href: "#/drills", label: "Drills" },
  { page: "system", href: "#/system", label: "System" },
] as const;

const isNumber = (text: string | undefined): text is string => /^[1-9]\d*$/.test(text ?? "");

/** What an address means below each of its first words; unknown ones fall back to the page above. */
const READ: Readonly<Record<string, (below: readonly string[], query: string) => Route>> = {
  runs: ([id], query) =>
    isNumber(id)
      ? { page: "run", id: Number(id), query }
      : id === "compare"
        ? { page: "compare", query }
        : { page: "runs", query },
  tests: ([id]) => (id ? { page: "test", id: unescaped(id) } : { page: "tests" }),
  "new-test": () => ({ page: "test", id: null }),
  interlocks: ([what, id], query) =>
    what === "first-outs" && isNumber(id) ? { page: "first-out", id: Number(id), query } : { page: "interlocks" },
  controller: () => ({ page: "controller" }),
  rig: ([tab]) => ({ page: "rig", tab: RIG_TABS.find((known) => known === tab) ?? RIG_TABS[0] }),
  drills: () => ({ page: "drills" }),
  system: ([tab]) => ({ page: "system", tab: SYSTEM_TABS.find((known) => known === tab) ?? SYSTEM_TABS[0] }),
};

/** The page that an address means; Operate where it means none. */
export function routeOf(hash: string): Route {
  const [path = "", query = ""] = hash.replace(/^#\/?/, "").split(/\?(.*)/s);
  const [page = "", ...below] = path.split("/");
  return Object.hasOwn(READ, page) ? READ[page]!(below, query) : { page: "operate" };
}

/** The page whose entry in the navigation is lit. */
const ABOVE: Partial<Record<Route["page"], Route["page"]>> = {
  run: "runs",
  compare: "runs",
  test: "tests",
  "first-out": "interlocks",
};
export const entryOf = ({ page }: Route): Route["page"] => ABOVE[page] ?? page;

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

const asked = (query: string): string => (query === "" ? "" : `?${query}`);

export const testHref = (id: string | null): string =>
  id === null ? "#/new-test" : `#/tests/${encodeURIComponent(id)}`;
export const runHref = (id: number, query = ""): string => `#/runs/${id}${asked(query)}`;
export const runsHref = (query = ""): string => `#/runs${asked(query)}`;

export const firstOutHref = (id: number, query = ""): string => `#/interlocks/first-outs/${id}${asked(query)}`;
export const compareHref = (ids: readonly number[]): string => `#/runs/compare?ids=${ids.join(",")}`;
export const rigHref = (tab: RigTab): string => `#/rig/${tab}`;
export const systemHref = (tab: SystemTab): string => `#/system/${tab}`;

/** Writes what is shown into the address, without a step in the history. Pages hear of it as of any new address. */
export function replaceAddress(href: string): void {
  if (window.location.hash === href) return;
  window.history.replaceState(window.history.state, "", href);
  window.dispatchEvent(new HashChangeEvent("hashchange"));
}
