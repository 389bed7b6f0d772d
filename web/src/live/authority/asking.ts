// A request for command that this window made: until it is answered, withdrawn or too old. Pure.

import type { Lease } from "../types";

/** How long a request stands on the server. */
export const STANDS_S = 60;

/** `seen` once a status has shown it. */
export interface Asking {
  readonly id: number;
  readonly seen: boolean;
}

/** What has become of a request: it stands, command is free, or whoever has it keeps it. */
export function followRequest(
  asking: Asking | null,
  lease: Lease | null,
): { readonly asking: Asking | null; readonly word?: string } {
  if (asking === null) return { asking };
  if (lease === null) return { asking: null, word: "Nobody is in command now. Take command with C." };
  if (lease.requests.some(({ id }) => id === asking.id))
    return { asking: asking.seen ? asking : { ...asking, seen: true } };
  return asking.seen ? { asking: null, word: `${lease.holder} keeps control for now.` } : { asking };
}

/** For how long a request still stands, whole seconds, by this machine's clock or the time it was first seen. */
export function left_s(since: string, firstSeen_ms: number, now_ms: number): number {
  const asked_ms = Math.min(Date.parse(since) || firstSeen_ms, firstSeen_ms);
  const begun_ms = Math.max(asked_ms, firstSeen_ms - 1000 * STANDS_S); // a clock may be hours off
  return Math.max(0, Math.ceil(STANDS_S - (now_ms - begun_ms) / 1000));
}
