// Pages by the part of the address after `#`. Pure; App.svelte listens.

export type Route =
  | { readonly page: "operate" }
  | { readonly page: "runs" }
  | { readonly page: "run"; readonly id: number }
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
  const [page, id] = hash.replace(/^#\/?/, "").split("/");
  if (page === "runs" && id !== undefined && /^[1-9]\d*$/.test(id)) return { page: "run", id: Number(id) };
  if (page === "tests" && id !== undefined && id !== "") return { page: "test", id: unescaped(id) };
  if (page === "new-test") return { page: "test", id: null };
  return page === "runs" || page === "tests" ? { page } : { page: "operate" };
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

export const testHref = (id: string | null): string =>
  id === null ? "#/new-test" : `#/tests/${encodeURIComponent(id)}`;
export const runHref = (id: number): string => `#/runs/${id}`;
