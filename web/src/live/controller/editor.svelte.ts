// Controller settings as they are being tried: undone and redone, analysed by the server as one types, put in force.

import { Problem } from "../api";
import { textOf } from "../messages.svelte";
import { begin, change, redo, undo, type History } from "../tests/history";
import { Latest } from "../tests/latest";
import { changesBetween, withValue } from "./fields";
import { drop, keep, kept } from "./kept";
import { check, getController, getRevision, putInForce, restoreRevision } from "./requests";
import type { Checked, Compensator, Fault, InForce, Load, Settings, Tuning } from "./types";

const PAUSE_MS = 200;

export class ControllerEditor {
  /** What is in force, as far as this page knows. */
  base = $state.raw<InForce | null>(null);
  failure = $state("");
  saving = $state(false);
  /** What somebody else put in force meanwhile. */
  conflict = $state.raw<InForce | null>(null);
  /** What the server makes of the draft, and of what is in force under the same load. */
  checked = $state.raw<Checked | null>(null);
  beside = $state.raw<Checked | null>(null);
  load = $state.raw<Load>({ amplitude_n: 2000, load_hz: 50, tune_hz: 4 });
  private history = $state.raw<History<Settings> | null>(null);
  private readonly checks = new Latest();
  private readonly besides = new Latest();

  readonly draft: Settings | null = $derived(this.history?.now ?? null);
  readonly changes = $derived(this.base && this.draft ? changesBetween(this.base.document, this.draft) : []);
  readonly dirty = $derived(this.changes.length > 0);
  readonly faults: readonly Fault[] = $derived(this.checked?.errors ?? []);
  readonly canUndo = $derived((this.history?.past.length ?? 0) > 0);
  readonly canRedo = $derived((this.history?.future.length ?? 0) > 0);
  /** The gains with which the branch is exact at the frequency that was asked for last. */
  readonly tuning: Tuning | null = $derived.by(() => {
    const found = this.checked?.compensator?.tuning ?? null;
    return found?.frequency_hz === this.load.tune_hz ? found : null;
  });

  /** Reads what is in force, and takes up the draft that this browser may have. */
  async open(): Promise<void> {
    try {
      this.base = await getController();
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
      return;
    }
    const found = kept(localStorage);
    this.history = begin(this.base.document);
    if (found !== null && changesBetween(this.base.document, found.settings).length > 0) {
      this.history = change(this.history, found.settings, null, 0);
      if (found.basedOn < this.base.revision) this.conflict = this.base;
    } else drop(localStorage);
    this.ask(0);
  }

  /** Reads again what is in force; a draft is kept, and is in conflict with what is new. */
  async reread(): Promise<void> {
    try {
      const now = await getController();
      if (now.revision === (this.conflict ?? this.base)?.revision) {
        if (this.conflict === null) this.base = now;
      } else if (this.dirty) this.conflict = now;
      else this.takeOver(now);
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  set(path: string, value: number | null): void {
    if (this.draft !== null) this.step(withValue(this.draft, path, value), path);
  }

  setCompensator(compensator: Compensator): void {
    if (this.draft !== null) this.step({ ...this.draft, compensator }, null);
  }

  /** FF_V and FF_A as they are exact at the frequency that was asked for. */
  tune(): void {
    if (this.tuning === null || this.draft === null) return;
    const { ff_v, ff_a } = this.tuning;
    const round = (value: number): number => Number(value.toPrecision(5));
    this.setCompensator({ ...this.draft.compensator, ff_v: round(ff_v), ff_a: round(ff_a) });
  }

  lookAt(load: Partial<Load>): void {
    this.load = { ...this.load, ...load };
    this.ask(PAUSE_MS);
  }

  /** An older revision as a draft; nothing is put in force by that. */
  async takeUp(number: number): Promise<void> {
    const { document } = await getRevision(number);
    this.step(document, null);
  }

  undo(): void {
    if (this.history !== null) this.turnTo(undo(this.history));
  }
  redo(): void {
    if (this.history !== null) this.turnTo(redo(this.history));
  }

  /** Forgets the draft. */
  discard(): void {
    const now = this.conflict ?? this.base;
    if (now !== null) this.takeOver(now);
  }

  /** Goes on with the draft on top of what somebody else has put in force. */
  stay(): void {
    if (this.conflict === null) return;
    this.base = this.conflict;
    this.conflict = null;
    this.ask(0);
  }

  /** Puts the draft in force. @returns whether it is. */
  async apply(why: string, lease: number | undefined): Promise<boolean> {
    const { draft } = this;
    return draft !== null && this.saved((based_on) => putInForce(draft, { why, based_on, lease }));
  }

  /** Puts an earlier revision in force again. @returns whether it is. */
  async restore(number: number, why: string, lease: number | undefined): Promise<boolean> {
    return this.saved((based_on) => restoreRevision(number, { why, based_on, lease }));
  }

  close(): void {
    this.checks.cancel();
    this.besides.cancel();
  }

  private async saved(put: (based_on: number) => Promise<InForce>): Promise<boolean> {
    if (this.base === null || this.saving || this.conflict !== null) return false;
    this.saving = true;
    try {
      this.takeOver(await put(this.base.revision));
      return true;
    } catch (error) {
      this.failure = textOf(error);
      if (error instanceof Problem && error.code === "edit_conflict") await this.reread();
      return false;
    } finally {
      this.saving = false;
    }
  }

  private takeOver(now: InForce): void {
    this.base = now;
    this.conflict = null;
    this.failure = "";
    this.history = begin(now.document);
    drop(localStorage);
    this.ask(0);
  }

  private step(next: Settings, about: string | null): void {
    if (this.history !== null) this.turnTo(change(this.history, next, about, performance.now()));
  }

  private turnTo(history: History<Settings>): void {
    this.history = history;
    const basedOn = this.base?.revision ?? 0;
    if (this.dirty) keep(localStorage, { basedOn, settings: history.now });
    else drop(localStorage);
    this.ask(PAUSE_MS);
  }

  private ask(pause_ms: number): void {
    const { draft, base, load } = this;
    if (draft === null || base === null) return;
    this.checks.ask(pause_ms, async (signal) => {
      await this.answer(check(draft, load, signal), signal, (found) => (this.checked = found));
    });
    this.besides.ask(pause_ms, async (signal) => {
      await this.answer(check(base.document, load, signal), signal, (found) => (this.beside = found));
    });
  }

  private async answer(asked: Promise<Checked>, signal: AbortSignal, take: (found: Checked) => void): Promise<void> {
    try {
      const found = await asked;
      if (signal.aborted) return;
      take(found);
      this.failure = "";
    } catch (error) {
      if (!signal.aborted) this.failure = textOf(error);
    }
  }
}
