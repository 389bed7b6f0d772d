// One test as it is being written: by form and by YAML, both saying the same as soon as the server has said so.

import { Problem } from "../api";
import { entry } from "../entry.svelte";
import { textOf } from "../messages.svelte";
import { commentsIn } from "./comments";
import { dropDraft, keepDraft, keptDraft, type Draft } from "./drafts";
import { amend, begin, change, redo, undo, type History } from "./history";
import { NEW_TEST } from "./kinds";
import { Latest } from "./latest";
import { checkTest, createTest, getTest, reviseTest } from "./requests";
import { setAt, type Json, type Path } from "./tree";
import type { Checked, Definition, Fault, Outline, TestDetail, TestText } from "./types";

const AGAIN_MS = 2000;
const PAUSE_MS = { form: 120, yaml: 250 } as const;

/** A state of the draft. `agreed`: form and YAML are known to say the same. */
interface Written {
  readonly yaml: string;
  readonly definition: Definition;
  readonly from: "form" | "yaml";
  readonly agreed: boolean;
}

/** What of the draft can be run: it has no faults. */
export interface Sound {
  readonly yaml: string;
  readonly outline: Outline;
  /** The definition with every default filled in, as it would be saved. */
  readonly whole: Definition;
}

export class Editor {
  base = $state.raw<TestDetail | null>(null);
  loaded = $state(false);
  failure = $state("");
  faults = $state.raw<readonly Fault[]>([]);
  sound = $state.raw<Sound | null>(null);
  saving = $state(false);
  /** Who saved what meanwhile. */
  conflict = $state.raw<TestDetail | null>(null);
  /** Since when a draft that was found waits to be saved. */
  foundDraft = $state<string | null>(null);
  /** It was saved as another test: there is nothing left here to be lost. */
  private elsewhere = $state(false);
  private history = $state.raw<History<Written>>(begin(blank()));
  private accepted = $state("");
  private readonly checks = new Latest();

  readonly now = $derived(this.history.now);
  readonly name = $derived(typeof this.now.definition.name === "string" ? this.now.definition.name : "");
  readonly comments = $derived(commentsIn(this.now.yaml));
  /** The form may be used: it would lose no comment, or a person has said that it may. */
  readonly formOpen = $derived(this.comments.length === 0 || this.accepted === this.comments.join("\n"));
  readonly dirty = $derived(
    !this.elsewhere &&
      (this.base === null ? this.history.past.length > 0 || this.foundDraft !== null : !this.isSaved(this.now)),
  );
  readonly canUndo = $derived(this.history.past.length > 0);
  readonly canRedo = $derived(this.history.future.length > 0);
  /** The form or the YAML shows an older state: the other one has faults that it cannot show. */
  readonly lagging = $derived(this.now.agreed ? null : this.now.from === "form" ? "yaml" : "form");

  constructor(readonly id: string | null) {}

  /** Reads the test, and the draft of it that this browser may have. */
  async load(): Promise<void> {
    try {
      if (this.id !== null) this.base = await getTest(this.id);
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
      return;
    }
    const draft = keptDraft(localStorage, this.id);
    this.history = begin(this.base === null ? blank() : asWritten(this.base));
    if (draft !== null) this.takeUp(draft);
    this.loaded = true;
    this.check(0);
  }

  /** Reads again what is saved, where only its circumstances changed: tags, archived or not. */
  async reread(): Promise<void> {
    if (this.id === null) return;
    const now = await getTest(this.id);
    if (now.revision === this.base?.revision) this.base = now;
  }

  /** A change by the form; `about` is what it is about, so that typing is one step. */
  set(path: Path, value: Json | undefined, about: string | null = null): void {
    this.replace(setAt(this.now.definition, path, value), about);
  }

  replace(definition: Definition, about: string | null = null): void {
    if (!this.formOpen) return;
    this.step({ ...this.now, definition, from: "form", agreed: false }, about);
  }

  /** A change of the text. */
  type(yaml: string): void {
    this.step({ ...this.now, yaml, from: "yaml", agreed: false }, "yaml");
  }

  acceptLoss(): void {
    this.accepted = this.comments.join("\n");
  }

  undo(): void {
    this.history = undo(this.history);
    this.changed();
  }

  redo(): void {
    this.history = redo(this.history);
    this.changed();
  }

  /** Back to what is saved; this too can be undone. */
  discard(): void {
    this.foundDraft = null;
    this.conflict = null;
    if (this.base !== null) return this.step(asWritten(this.base), null);
    this.history = begin(blank());
    this.changed();
  }

  /** Gives up this edit for what somebody else saved meanwhile; this too can be undone. */
  takeTheirs(): void {
    if (this.conflict !== null) this.base = this.conflict;
    this.discard();
  }

  /** Saves a new revision on top of the one that was edited, or of `onTopOf`. @returns the test, if it was saved. */
  async save(comment: string, onTopOf?: number): Promise<TestDetail | null> {
    if (this.conflict !== null && onTopOf === undefined) return null;
    const how = { comment, author: entry.operator.trim() };
    return this.saved(async (text) =>
      this.id === null
        ? createTest(text, how)
        : reviseTest(this.id, text, { ...how, based_on: onTopOf ?? this.base!.revision }),
    );
  }

  /** Saves this edit as a test of its own, under another name. */
  async saveAsClone(comment: string): Promise<TestDetail | null> {
    const how = { comment, author: entry.operator.trim(), tags: this.base?.tags ?? [] };
    const { now } = this;
    const text = now.agreed ? { yaml: renamed(now.yaml, `${this.name}, copy`) } : textToCheck(now);
    return this.saved(() => createTest(text, how));
  }

  close(): void {
    this.checks.cancel();
  }

  private takeUp(draft: Draft): void {
    const { yaml, definition, from } = draft;
    if (this.base !== null && yaml === this.base.yaml) return dropDraft(localStorage, this.id);
    this.history = change(this.history, { yaml, definition, from, agreed: false }, null, 0);
    this.foundDraft = draft.keptAt;
    if (this.base !== null && draft.basedOn !== null && draft.basedOn < this.base.revision)
      this.conflict = this.base;
  }

  private step(next: Written, about: string | null): void {
    this.history = change(this.history, next, about, performance.now());
    this.changed();
  }

  private changed(): void {
    this.keep();
    this.check(PAUSE_MS[this.now.from]);
  }

  private keep(): void {
    if (!this.dirty) return dropDraft(localStorage, this.id);
    const { yaml, definition, from } = this.now;
    const keptAt = new Date().toISOString();
    const basedOn = this.conflict === null ? (this.base?.revision ?? null) : this.conflict.revision - 1;
    keepDraft(localStorage, this.id, { basedOn, name: this.name, yaml, definition, from, keptAt });
  }

  private check(pause_ms: number): void {
    this.checks.ask(pause_ms, (signal) => this.ask(signal));
  }

  private async ask(signal: AbortSignal): Promise<void> {
    try {
      const checked = await checkTest(textToCheck(this.now), signal);
      if (!signal.aborted) this.take(checked);
    } catch (error) {
      if (signal.aborted) return;
      this.failure = textOf(error);
      if (mayPass(error)) this.check(AGAIN_MS);
    }
  }

  private take({ problems, definition, yaml, outline, whole }: Checked): void {
    const { now } = this;
    this.failure = "";
    this.faults = problems;
    const other = now.from === "form" ? { yaml: now.agreed ? now.yaml : yaml } : { definition };
    const agreed = Object.values(other).every((side) => side !== null && side !== undefined);
    if (agreed) this.history = amend(this.history, { ...now, ...(other as Partial<Written>), agreed });
    this.sound = agreed && outline && whole ? { yaml: this.now.yaml, outline, whole } : null;
    this.keep();
  }

  private async saved(send: (text: TestText) => Promise<TestDetail>): Promise<TestDetail | null> {
    this.saving = true;
    try {
      const { now } = this;
      const detail = await send(now.agreed ? { yaml: now.yaml } : textToCheck(now));
      this.conflict = this.foundDraft = null;
      this.failure = "";
      if (detail.id === this.id) this.base = detail;
      else this.elsewhere = true;
      this.keep();
      return detail;
    } catch (error) {
      await this.refused(error);
      return null;
    } finally {
      this.saving = false;
    }
  }

  private async refused(error: unknown): Promise<void> {
    if (error instanceof Problem && error.code === "edit_conflict" && this.id !== null) {
      this.conflict = await getTest(this.id).catch(() => null);
      if (this.conflict !== null) return;
    }
    this.failure = textOf(error);
  }

  private isSaved(written: Written): boolean {
    return this.base !== null && written.yaml === this.base.yaml && (written.agreed || written.from === "yaml");
  }
}

/** Whether asking again may do: nobody answered, or was too busy to. */
const mayPass = (error: unknown): boolean =>
  !(error instanceof Problem) || error.status === null || error.status === 429 || error.status >= 500;

const textToCheck = ({ yaml, definition, from }: Written): TestText =>
  from === "yaml" ? { yaml } : { definition };

const asWritten = ({ yaml, definition }: TestDetail): Written => ({
  ...{ yaml, definition },
  ...{ from: "yaml", agreed: true },
});

/** The text under another name: only that line changes, so that comments stay. */
const renamed = (yaml: string, name: string): string =>
  yaml.replace(/^name:(?=\s).*$/m, () => `name: ${JSON.stringify(name)}`);

const blank = (): Written => ({ yaml: "", definition: NEW_TEST, from: "form", agreed: false });
