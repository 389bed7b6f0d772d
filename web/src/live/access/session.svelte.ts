// Whether somebody is signed in here, and who. Nobody's page is taken away when their session ends: it waits.

import { Problem } from "../api";
import { textOf } from "../messages.svelte";
import { badge } from "./badge";
import { getMe, setPassword, signIn, signOut } from "./requests";
import { lacking, type Role } from "./roles";
import type { Me } from "./types";

const TRY_AGAIN_MS = 2000;

/** `asking`: not known yet. `ended`: somebody was signed in, and is not any more. */
type SessionState = "asking" | "out" | "in" | "ended";

class Session {
  state = $state<SessionState>("asking");
  /** Who is signed in, or was until now. */
  me = $state.raw<Me | null>(null);
  /** Why it is not known yet whether somebody is signed in. */
  trouble = $state("");
  /** A person asked to leave: nothing to be surprised at. */
  left = $state(false);

  readonly isIn = $derived(this.state === "in");
  readonly role: Role | null = $derived(this.state === "in" ? (this.me?.role ?? null) : null);
  readonly id: string | null = $derived(this.state === "in" ? (this.me?.id ?? null) : null);
  /** An account that was entered by its sign-in link has no password to come back with. */
  readonly needsPassword = $derived(this.state === "in" && this.me?.must_set_password === true);

  /** Finds out who is signed in, and hears of it when nobody is any more. */
  start(): void {
    badge.refused = () => this.end();
    void this.ask();
  }

  /** Asks the server again; where it does not answer, until it does. */
  async ask(): Promise<void> {
    try {
      this.enter(await getMe());
    } catch (error) {
      if (error instanceof Problem && error.code === "not_signed_in") return this.end();
      if (this.state !== "asking") return; // signed in as far as anybody knows
      this.trouble = textOf(error);
      window.setTimeout(() => void this.ask(), TRY_AGAIN_MS);
    }
  }

  async signIn(name: string, password: string): Promise<void> {
    await signIn(name, password);
    this.enter(await getMe());
  }

  async signOut(): Promise<void> {
    await signOut();
    this.left = true;
    this.end();
  }

  async changePassword(current: string | null, password: string): Promise<void> {
    await setPassword(current, password);
    this.enter(await getMe());
  }

  /** Nobody is signed in any more; who it was is kept for their return. */
  end(): void {
    badge.csrf = "";
    this.state = this.me === null ? "out" : "ended";
    this.trouble = "";
  }

  may(needed: Role): boolean {
    return lacking(this.role, needed) === null;
  }

  /** Why whoever is signed in may not; null where they may. */
  lacks(needed: Role): string | null {
    return lacking(this.role, needed);
  }

  private enter(me: Me): void {
    badge.csrf = me.csrf_token ?? "";
    this.me = me;
    this.trouble = "";
    this.left = false;
    this.state = "in";
  }
}

export const session = new Session();
