// The frequency response of one run: read, asked for again while it is computed or grows, with live points on top.

import { textOf } from "../messages.svelte";
import { frequencyResponse, isComputing } from "./requests";
import { merged } from "./merging";
import type { FrequencyResponse, ResponseFrame, TransferName } from "./types";

/** While it runs the server is asked for extremes, model and time left this often; points come by themselves. */
const AGAIN_MS = 2000;
const COMPUTING_MS = 300;

export class RunResponse {
  transfer = $state<TransferName>("force");
  data = $state.raw<FrequencyResponse | null>(null);
  /** The share that is done while it is computed; null where it is not. */
  computing = $state<number | null>(null);
  failure = $state("");
  private asked = new AbortController();
  private timer = 0;

  constructor(
    readonly runId: number,
    /** Whether the run is under way: then it is asked for again and again. */
    private readonly grows: () => boolean,
  ) {
    void this.read();
  }

  show(transfer: TransferName): void {
    if (transfer === this.transfer) return;
    this.transfer = transfer;
    void this.read();
  }

  /** A point has come. */
  take(frame: ResponseFrame): void {
    if (frame.run === this.runId && this.data !== null) this.data = merged(this.data, frame);
  }

  end(): void {
    this.asked.abort();
    window.clearTimeout(this.timer);
  }

  async read(): Promise<void> {
    this.end();
    this.asked = new AbortController();
    const { signal } = this.asked;
    try {
      const answer = await frequencyResponse(this.runId, this.transfer, signal);
      if (signal.aborted) return;
      this.failure = "";
      if (isComputing(answer)) this.computing = answer.share;
      else if (!answer.available.includes(this.transfer)) return this.show(answer.available[0] ?? "force");
      else [this.data, this.computing] = [answer, null];
    } catch (error) {
      if (signal.aborted) return;
      [this.failure, this.computing] = [textOf(error), null];
    }
    if (this.computing !== null) this.again(COMPUTING_MS);
    else if (this.grows()) this.again(AGAIN_MS);
  }

  private again(after_ms: number): void {
    this.timer = window.setTimeout(() => void this.read(), after_ms);
  }
}
