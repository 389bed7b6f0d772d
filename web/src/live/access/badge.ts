// What every request shows so that it is let in, and who hears of one that was not. No state of the screen.

interface Badge {
  /** Goes with every request that may change something: another site's page does not know it. */
  csrf: string;
  /** Called where the server says that nobody is signed in. */
  refused: () => void;
}

export const badge: Badge = { csrf: "", refused: () => {} };

const SAFE = new Set(["GET", "HEAD", "OPTIONS"]);

/** The headers of a request, with those of access. */
export function withBadge(method: string | undefined, headers: HeadersInit | undefined): Headers {
  const all = new Headers(headers);
  if (!all.has("Accept")) all.set("Accept", "application/json");
  if (badge.csrf !== "" && !SAFE.has(method ?? "GET")) all.set("X-CSRF-Token", badge.csrf);
  return all;
}
