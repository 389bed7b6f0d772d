// The table as it is being written: undone and redone, checked by the server, saved on top of what is in force.

import { Problem } from "../api";
import { textOf } from "../messages.svelte";
import { begin, change, redo, undo, type History } from "../tests/history";
import { Latest } from "../tests/latest";
import { changesBetween } from "./changes";
import * as draft from "./draft";
import { drop, keep, kept } from "./kept";
import { checkTable, getInterlocks, getRevision, saveTable } from "./requests";
import type { Detector, Fault, InForce, TableText, Weakened } from "./types";

const PAUSE_MS = 150;

export class TableEditor {
  /** What is in force, as far as this page knows. */
  base = $state.raw<InForce | null>(null);
  editing = $state(false);
  failure = $state("");
  faults = $state.raw<readonly Fault[]>([]);
  /** Where the draft protects people less than the table as shipped. */
  weakened = $state.raw<readonly Weakened[]>([]);
  /** Guarded detectors that a person has said may be weaker. */
  accepted = $state.raw<readonly string[]>([]);
  saving = $state(false);
  /** What somebody else saved meanwhile. */
  conflict = $state.raw<InForce | null>(null);
  /** Since when a draft that was found waits to be saved. */
  foundDraft = $state<string | null>(null);
  private history = $state.raw<History<draft.Table>>(begin([]));
  private readonly checks = new Latest();

  readonly table: draft.Table = $derived(this.editing ? this.history.now : (this.base?.detectors ?? []));
  readonly changes = $derived(this.editing && this.base ? changesBetween(this.base.detectors, this.history.now) : []);
  readonly unsaid = $derived(this.weakened.filter(({ detector }) => !this.accepted.includes(detector)));
  readonly dirty = $derived(this.changes.length > 0);
  readonly canUndo = $derived(this.editing && this.history.past.length > 0);
  readonly canRedo = $derived(this.editing && this.history.future.length > 0);

  /** Reads what is in force, and takes up the draft that this browser may have. */
  async load(): Promise<void> {
    try {
      this.base = await getInterlocks();
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
      return;
    }
    const found = this.editing ? null : kept(localStorage);
    if (found !== null) this.takeUp(found.detectors, found.basedOn, found.keptAt);
  }

  /** Reads again what is in force; somebody's edit under way is kept, and is in conflict with what is new. */
  async reread(): Promise<void> {
    try {
      const now = await getInterlocks();
      if (!this.editing) this.base = now;
      else if (now.revision !== (this.conflict ?? this.base)?.revision) this.conflict = now;
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  edit(): void {
    if (this.base === null || this.editing) return;
    this.history = begin(this.base.detectors);
    this.accepted = this.base.knowingly_weaker;
    this.editing = true;
    this.check(0);
  }

  /** Begins with the table of an older revision; nothing is saved by that. */
  async restore(number: number): Promise<void> {
    const old = await getRevision(number);
    this.edit();
    this.step(old.detectors, null);
  }

  /** Says that a guarded detector may be weaker, or takes that back. */
  accept(name: string, on: boolean): void {
    this.accepted = [...this.accepted.filter((other) => other !== name), ...(on ? [name] : [])];
  }

  set(at: number, changes: Partial<Detector>, about: string | null = null): void {
    this.step(draft.changed(this.history.now, at, changes), about);
  }
  add(): void {
    this.step(draft.added(this.history.now), null);
  }
  duplicate(at: number): void {
    this.step(draft.duplicated(this.history.now, at), null);
  }
  remove(at: number): void {
    this.step(draft.removed(this.history.now, at), null);
  }
  move(at: number, steps: number): void {
    this.step(draft.moved(this.history.now, at, steps), null);
  }

  undo(): void {
    if (!this.canUndo) return;
    this.history = undo(this.history);
    this.changed();
  }

  redo(): void {
    if (!this.canRedo) return;
    this.history = redo(this.history);
    this.changed();
  }

  /** Ends the edit and forgets what was written. */
  discard(): void {
    this.checks.cancel();
    if (this.conflict !== null) this.base = this.conflict;
    this.editing = false;
    this.conflict = this.foundDraft = null;
    this.faults = [];
    this.weakened = [];
    this.failure = "";
    drop(localStorage);
  }

  /**
   * Puts the draft in force, on top of the revision that was edited.
   * @param over on top of what somebody else saved meanwhile. @returns whether it was saved.
   */
  async save(why: string, lease: number | undefined, over = false): Promise<boolean> {
    if (this.base === null || this.saving || (this.conflict !== null && !over)) return false;
    const based_on = (this.conflict ?? this.base).revision;
    this.saving = true;
    try {
      const saved = await saveTable(this.text, { why, based_on, lease });
      this.conflict = null;
      this.discard();
      this.base = saved;
      return true;
    } catch (error) {
      await this.refused(error);
      return false;
    } finally {
      this.saving = false;
    }
  }

  close(): void {
    this.checks.cancel();
  }

  private get text(): TableText {
    const weaker = new Set(this.weakened.map(({ detector }) => detector));
    return { detectors: this.history.now, knowingly_weaker: this.accepted.filter((name) => weaker.has(name)) };
  }

  private takeUp(detectors: draft.Table, basedOn: number, keptAt: string): void {
    if (changesBetween(this.base!.detectors, detectors).length === 0) return drop(localStorage);
    this.edit();
    this.history = change(this.history, detectors, null, 0);
    this.foundDraft = keptAt;
    if (basedOn < this.base!.revision) this.conflict = this.base;
    this.check(0);
  }

  private step(next: draft.Table, about: string | null): void {
    if (next === this.history.now) return;
    this.history = change(this.history, next, about, performance.now());
    this.changed();
  }

  private changed(): void {
    const { base } = this;
    if (base === null) return;
    const basedOn = this.conflict === null ? base.revision : this.conflict.revision - 1;
    if (this.dirty) keep(localStorage, { basedOn, detectors: this.history.now, keptAt: new Date().toISOString() });
    else drop(localStorage);
    this.check(PAUSE_MS);
  }

  private check(pause_ms: number): void {
    this.checks.ask(pause_ms, async (signal) => {
      try {
        const { errors, weakened } = await checkTable(this.text, signal);
        if (signal.aborted) return;
        this.faults = errors.map(({ expected, value = null, ...fault }) => ({ ...fault, value, message: expected }));
        this.weakened = weakened;
        this.failure = "";
      } catch (error) {
        if (!signal.aborted) this.failure = textOf(error);
      }
    });
  }

  private async refused(error: unknown): Promise<void> {
    if (error instanceof Problem && error.code === "edit_conflict") {
      this.conflict = await getInterlocks().catch(() => null);
      if (this.conflict !== null) return;
    }
    this.failure = textOf(error);
  }
}
