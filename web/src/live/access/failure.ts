// Why a sign-in did not succeed, in words that help. Pure.

import { Problem } from "../api";
import { textOf } from "../messages.svelte";

export interface Failure {
  readonly text: string;
  /** Until when no further attempt is taken; absent where one may try at once. */
  readonly until_ms?: number;
}

/** The sentence for a sign-in that failed at `now_ms`, and how long to wait where there were too many. */
export function signInFailure(error: unknown, now_ms: number): Failure {
  if (!(error instanceof Problem)) return { text: textOf(error) };
  const wait_s = error.document["retry_after_s"];
  if (error.status === 429 && typeof wait_s === "number")
    return { text: "Too many attempts. The time left is on the button.", until_ms: now_ms + 1000 * wait_s };
  return { text: error.detail };
}
