// Pages by the part of the address after `#`: a path and, behind `?`, what is shown there. Pure; App.svelte listens.

export type Route =
  | { readonly page: "operate" }
  | { readonly page: "runs"; readonly query: string }
  | { readonly page: "run"; readonly id: number; readonly query: string }
  | { readonly page: "tests" }
  /** A test of the library; null: one that is being written. */
  | { readonly page: "test"; readonly id: string | null };

export const PAGES = [
  { page: "operate", href: "#/operate", label: "Operate" },
  { page: "tests", href: "#/tests", label: "Tests" },
  { page: "runs", href: "#/runs", label: "Runs" },
] as const;

/** The page that an address means; Operate where it means none. */
export function routeOf(hash: string): Route {
  const [path = "", query = ""] = hash.replace(/^#\/?/, "").split(/\?(.*)/s);
  const [page, id] = path.split("/");
  if (page === "runs" && id !== undefined && /^[1-9]\d*$/.test(id)) {
    return { page: "run", id: Number(id), query };
  }
  if (page === "tests" && id !== undefined && id !== "") return { page: "test", id: unescaped(id) };
  if (page === "new-test") return { page: "test", id: null };
  if (page === "runs") return { page, query };
  return page === "tests" ? { page } : { page: "operate" };
}

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

/** Writes what is shown into the address, without a step in the history. Pages hear of it as of any new address. */
export function replaceAddress(href: string): void {
  if (window.location.hash === href) return;
  window.history.replaceState(window.history.state, "", href);
  window.dispatchEvent(new HashChangeEvent("hashchange"));
}
