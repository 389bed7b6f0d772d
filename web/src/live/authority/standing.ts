// Who is in command, as seen from this window. Pure.

import { atLeast, lacking, type Role } from "../access/roles";
import type { Lease } from "../types";

/** The command that this window holds; `seen` once a status has shown it. */
export interface Hold {
  readonly epoch: number;
  readonly seen: boolean;
}

export type Standing =
  | { readonly is: "nobody" }
  | { readonly is: "here"; readonly lease: Lease }
  /** The same person, signed in once, in another window. */
  | { readonly is: "other-window"; readonly lease: Lease }
  | { readonly is: "other"; readonly lease: Lease };

export function standingOf(lease: Lease | null, hold: Hold | null, me: string | null): Standing {
  if (lease === null) return { is: "nobody" };
  if (lease.holder_id !== me) return { is: "other", lease };
  return { is: hold?.epoch === lease.epoch ? "here" : "other-window", lease };
}

/** Who it is, short enough for the header. */
export function holderWords(standing: Standing): string {
  if (standing.is === "nobody") return "Nobody";
  if (standing.is === "here") return "You";
  return standing.is === "other-window" ? "You, elsewhere" : standing.lease.holder;
}

/** Why somebody may give no command that needs command; null where they may. */
export function notInCommand(standing: Standing, role: Role | null): string | null {
  if (!atLeast(role, "operator")) return lacking(role, "operator");
  if (standing.is === "here") return null;
  if (standing.is === "nobody") return "Take command first: C";
  if (standing.is === "other-window") return "You are in command in another window. Take it here: C";
  return `${standing.lease.holder} is in command. Ask for command: C`;
}

/** What a status made of what this window held, or of what it had asked for. */
export interface Followed {
  readonly hold: Hold | null;
  /** Command was here and is not any more: the one who has it now, or nobody. */
  readonly lost?: { readonly to: Lease | null };
  /** What was asked for was given. */
  readonly given?: true;
}

/** Follows the status. One from before a grant says nothing against it. */
export function follow(hold: Hold | null, lease: Lease | null, me: string | null, asking: boolean): Followed {
  const mine = lease !== null && lease.holder_id === me;
  if (hold === null)
    return mine && asking ? { hold: { epoch: lease.epoch, seen: true }, given: true } : { hold };
  if (mine && lease.epoch === hold.epoch) return { hold: hold.seen ? hold : { ...hold, seen: true } };
  const newer = lease !== null && lease.epoch > hold.epoch;
  return hold.seen || newer ? { hold: null, lost: { to: lease } } : { hold };
}

/** What the banner says to whoever was in command and is no longer. */
export function lossWords(to: Lease | null, me: string | null): string {
  if (to === null) return "Control has ended here: nothing was heard from this window for too long.";
  if (to.holder_id === me) return "Control has begun anew: in another window of yours, or with a new loop. Take it here again: C.";
  const why = to.reason === "" ? "" : ` Reason: ${to.reason}`;
  return `Control has passed to ${to.holder}, ${to.role}.${why}`;
}

/** How long ago something began, as one says it: `just now`, `4 min`, `2 h`. */
export function sinceWords(iso: string, now_ms: number): string {
  const minutes = Math.floor((now_ms - Date.parse(iso)) / 60_000);
  if (!(minutes >= 1)) return "just now";
  return minutes < 120 ? `${minutes}\u00a0min` : `${Math.floor(minutes / 60)}\u00a0h`;
}
