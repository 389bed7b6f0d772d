// Command of the rig, as this window has it: taking, keeping, asking, giving.

import { session } from "../access/session.svelte";
import { messages, textOf } from "../messages.svelte";
import type { Lease } from "../types";
import { followRequest, type Asking } from "./asking";
import { askForLease, dropRequest, handOver, releaseLease, takeLease } from "./requests";
import { follow, lossWords, notInCommand, standingOf, type Hold, type Standing } from "./standing";

const TOPIC = "authority";
/** A reload of the window keeps what it held; another window has nothing of it. */
const KEPT = "forcerig.epoch";
const BEAT_EVERY_S = 1;

class Authority {
  lease = $state.raw<Lease | null>(null);
  hold = $state.raw<Hold | null>(kept());
  /** The request that this window made and that nobody has answered. */
  asking = $state.raw<Asking | null>(null);
  /** What befell command here, until somebody has read it. */
  notice = $state<{ readonly text: string; readonly bad: boolean } | null>(null);
  /** The panel under the holder's name is open. */
  open = $state(false);
  busy = $state(false);
  private beatAt_s = -Infinity;

  readonly standing: Standing = $derived(standingOf(this.lease, this.hold, session.id));
  readonly notInCommand = $derived(notInCommand(this.standing, session.role));
  /** What a command from here bears: without one the loop would not obey it. */
  readonly epoch = $derived(this.hold?.epoch);

  /** Follows a status. @returns the epoch for a beat where one is due */
  follow(lease: Lease | null, now_s: number): number | null {
    const { hold, lost, given } = follow(this.hold, lease, session.id, this.asking !== null);
    const { asking, word } = followRequest(given ? null : this.asking, lease);
    this.lease = lease;
    this.asking = asking;
    if (hold !== this.hold) this.keep(hold);
    if (lost) this.notice = { text: lossWords(lost.to, session.id), bad: true };
    else if (given) this.notice = { text: "You are in command now.", bad: false };
    else if (word !== undefined) this.notice = { text: word, bad: false };
    if (hold === null || lease?.epoch !== hold.epoch || now_s - this.beatAt_s < BEAT_EVERY_S) return null;
    this.beatAt_s = now_s;
    return hold.epoch;
  }

  /** Takes command, or takes it over from whoever has it. */
  take(reason: string, over = false): Promise<boolean> {
    return this.attempt(over ? "Taking over" : "Taking control", async () => {
      const { epoch } = await takeLease(reason.trim(), over);
      this.keep({ epoch, seen: false });
      this.notice = null;
      this.open = false;
    });
  }

  release(): Promise<boolean> {
    return this.attempt("Releasing control", async () => {
      this.keep(null);
      await releaseLease();
      this.open = false;
    });
  }

  ask(reason: string): Promise<boolean> {
    return this.attempt("Asking for command", async () => {
      this.asking = { id: (await askForLease(reason.trim())).id, seen: false };
      this.open = false;
    });
  }

  withdraw(): Promise<boolean> {
    const asking = this.asking;
    this.asking = null;
    return this.attempt("Withdrawing", async () => asking && dropRequest(asking.id));
  }

  give(id: number): Promise<boolean> {
    return this.attempt("Giving control", async () => {
      const held = this.hold;
      this.keep(null); // whoever gives is not told that it has passed
      await handOver(id).catch((error: unknown) => {
        this.keep(held);
        throw error;
      });
    });
  }

  decline(id: number): Promise<boolean> {
    return this.attempt("Keeping control", () => dropRequest(id));
  }

  private async attempt(what: string, act: () => Promise<unknown>): Promise<boolean> {
    if (this.busy) return false;
    this.busy = true;
    try {
      await act();
      messages.clear(TOPIC);
      return true;
    } catch (error) {
      messages.show(TOPIC, `${what} failed. ${textOf(error)}`);
      return false;
    } finally {
      this.busy = false;
    }
  }

  private keep(hold: Hold | null): void {
    this.hold = hold;
    if (hold === null) sessionStorage.removeItem(KEPT);
    else sessionStorage.setItem(KEPT, String(hold.epoch));
  }
}

/** What this window held before it was reloaded; the first status says whether it still does. */
function kept(): Hold | null {
  const epoch = Number(sessionStorage.getItem(KEPT));
  return Number.isInteger(epoch) && epoch > 0 ? { epoch, seen: true } : null;
}

export const authority = new Authority();
