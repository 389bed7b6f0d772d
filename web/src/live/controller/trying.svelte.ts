// A draft on the virtual rig, beside what is in force: asked for, followed, given up.

import { textOf } from "../messages.svelte";
import { getPreview, giveUp, tryOut } from "./requests";
import type { Preview, Previewed, Settings } from "./types";

const AGAIN_MS = 300;

export class Trying {
  job = $state.raw<Preview | null>(null);
  result = $state.raw<Previewed | null>(null);
  /** The settings that the result is of. */
  of = $state.raw<Settings | null>(null);
  failure = $state("");
  private timer = 0;

  readonly running = $derived(this.job !== null);

  async start(settings: Settings, testId: string): Promise<void> {
    await this.stop();
    this.failure = "";
    try {
      this.of = settings;
      this.follow(await tryOut(settings, testId));
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  async stop(): Promise<void> {
    window.clearTimeout(this.timer);
    const { job } = this;
    this.job = null;
    if (job !== null) await giveUp(job.id).catch(() => null);
  }

  private follow(job: Preview): void {
    if (job.state === "done" || job.state === "failed" || job.state === "cancelled") {
      this.job = null;
      if (job.result) this.result = job.result;
      else this.failure = job.reason ?? "Nothing came of it.";
      return;
    }
    this.job = job;
    this.timer = window.setTimeout(() => void this.again(job.id), AGAIN_MS);
  }

  private async again(id: string): Promise<void> {
    try {
      const job = await getPreview(id);
      if (this.job?.id === id) this.follow(job);
    } catch (error) {
      this.job = null;
      this.failure = textOf(error);
    }
  }
}
