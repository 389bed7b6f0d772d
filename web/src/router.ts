// Pages by the part of the address after `#`. Pure; App.svelte listens.

export type Route =
  { readonly page: "operate" } | { readonly page: "runs" } | { readonly page: "run"; readonly id: number };

export const PAGES = [
  { page: "operate", href: "#/operate", label: "Operate" },
  { page: "runs", href: "#/runs", label: "Runs" },
] as const;

/** The page that an address means; Operate where it means none. */
export function routeOf(hash: string): Route {
  const [page, id] = hash.replace(/^#\/?/, "").split("/");
  if (page === "runs" && id !== undefined && /^[1-9]\d*$/.test(id)) return { page: "run", id: Number(id) };
  return page === "runs" ? { page: "runs" } : { page: "operate" };
}

export const runHref = (id: number): string => `#/runs/${id}`;
