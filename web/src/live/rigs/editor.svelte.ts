// The rig configuration as it is being written: undone and redone, put in force on top of what was edited.

import { Problem } from "../api";
import { textOf } from "../messages.svelte";
import { begin, change, redo, undo, type History } from "../tests/history";
import { changesBetween, withValue, type Value } from "./fields";
import { getConfiguration, getRevision, putInForce } from "./requests";
import type { Configuration, InForce } from "./types";

export class ConfigurationEditor {
  /** What is in force, as far as this page knows. */
  base = $state.raw<InForce | null>(null);
  editing = $state(false);
  saving = $state(false);
  failure = $state("");
  /** What the server said of single values when they were to come into force, by their place. */
  faults = $state.raw<Readonly<Record<string, string>>>({});
  private history = $state.raw<History<Configuration> | null>(null);

  readonly document: Configuration | null = $derived((this.editing ? this.history?.now : this.base?.document) ?? null);
  readonly changes = $derived(this.base && this.document ? changesBetween(this.base.document, this.document) : []);
  readonly canUndo = $derived(this.editing && (this.history?.past.length ?? 0) > 0);
  readonly canRedo = $derived(this.editing && (this.history?.future.length ?? 0) > 0);

  async load(): Promise<void> {
    try {
      this.base = await getConfiguration();
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  edit(): void {
    if (this.base === null || this.editing) return;
    this.history = begin(this.base.document);
    this.editing = true;
  }

  /** An older revision as a draft; nothing is put in force by that. */
  async takeUp(number: number): Promise<void> {
    const { document } = await getRevision(number);
    this.edit();
    if (this.history !== null) this.history = change(this.history, document, null, performance.now());
  }

  set(path: string, value: Value): void {
    if (this.history === null) return;
    this.history = change(this.history, withValue(this.history.now, path, value), path, performance.now());
  }
  undo(): void {
    if (this.history !== null && this.canUndo) this.history = undo(this.history);
  }
  redo(): void {
    if (this.history !== null && this.canRedo) this.history = redo(this.history);
  }

  /** Ends the edit and forgets what was written. */
  discard(): void {
    this.editing = false;
    this.history = null;
    this.failure = "";
    this.faults = {};
  }

  /** Puts the draft in force. @returns whether it is. */
  async apply(why: string, lease: number | undefined): Promise<boolean> {
    const { base, document } = this;
    if (base === null || document === null || this.saving) return false;
    this.saving = true;
    try {
      const saved = await putInForce(document, { why, based_on: base.revision, lease });
      this.discard();
      this.base = saved;
      return true;
    } catch (error) {
      this.failure = textOf(error);
      this.faults = error instanceof Problem ? faultsIn(error.document) : {};
      return false;
    } finally {
      this.saving = false;
    }
  }
}

function faultsIn(problem: Readonly<Record<string, unknown>>): Readonly<Record<string, string>> {
  const errors = Array.isArray(problem["errors"]) ? (problem["errors"] as { path: string; expected: string }[]) : [];
  return Object.fromEntries(errors.map(({ path, expected }) => [path, expected]));
}
