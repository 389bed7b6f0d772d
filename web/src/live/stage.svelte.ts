// What stands under the force chart: before a run its prediction, while it runs charts, after it its outcome.

import { runBlocks } from "./outlines.svelte";
import { rig } from "./rig.svelte";
import { tests } from "./tests.svelte";

export type Scene = "charts" | "prediction" | "outcome" | "resume" | "response";

const RESPONSE = "frequency_response"; // a kind of block

class Stage {
  /** A person's own choice of charts; it lasts until something else begins. */
  charts = $state(false);
  /** The run that ended while this page was open and has not been put away. */
  endedRun = $state<number | null>(null);
  private running: number | null = null;

  readonly offered: Scene = $derived.by(() => {
    const mode = rig.status?.mode;
    if (mode === "holding") return "resume";
    if (rig.status?.run) return runBlocks.blocks.some(({ kind }) => kind === RESPONSE) ? "response" : "charts";
    if (this.endedRun !== null) return "outcome";
    return tests.chosen === null ? "charts" : "prediction";
  });
  readonly scene: Scene = $derived(this.charts ? "charts" : this.offered);

  toggle(): void {
    this.charts = !this.charts;
  }

  /** Keeps account of the run under way: called with every status. */
  follow(run: number | null, mode: string): void {
    if (run !== this.running) this.charts = false;
    if (run !== null) this.endedRun = null;
    else if (this.running !== null && mode !== "lost") this.endedRun = this.running;
    this.running = run;
  }

  putAway(): void {
    this.endedRun = null;
  }
}

export const stage = new Stage();
