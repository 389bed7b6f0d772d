// The exports of one run: asked for, followed while they are made, removed.

import { textOf } from "../messages.svelte";
import { listExports, removeExport, startExport, type Export, type ExportWish } from "./requests";

const LOOK_MS = 500;
export const isUnderWay = ({ state }: Export): boolean => state === "waiting" || state === "running";

export class RunExports {
  list = $state.raw<readonly Export[]>([]);
  failure = $state("");
  private timer = 0;
  private ended = false;

  constructor(private readonly run: number) {
    void this.look();
  }

  async start(wish: ExportWish): Promise<void> {
    await this.attempt(() => startExport(this.run, wish));
  }

  /** Gives one up, or removes its file. */
  async remove(id: string): Promise<void> {
    await this.attempt(() => removeExport(this.run, id));
  }

  end(): void {
    this.ended = true;
    window.clearTimeout(this.timer);
  }

  private async attempt(what: () => Promise<unknown>): Promise<void> {
    try {
      await what();
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
    await this.look();
  }

  private async look(): Promise<void> {
    window.clearTimeout(this.timer);
    try {
      this.list = await listExports(this.run);
    } catch (error) {
      this.failure = textOf(error);
    }
    if (!this.ended && this.list.some(isUnderWay)) this.timer = window.setTimeout(() => void this.look(), LOOK_MS);
  }
}
