// From the ring to what uPlot draws: one ascending x for all series of a chart, in seconds before the newest sample.

import type { SampleRing } from "../live/ring";
import { bucketTicks } from "./decimate";
import { Envelope } from "./envelope";

export type Column = (number | null)[];

export class Trace {
  readonly x: number[] = [];
  readonly ys: Column[];
  /** Ticks a column; 1 where every sample is drawn. */
  bucket = 1;
  /** Extremes over the series that are shown; NaN where there is nothing to draw. */
  low = NaN;
  high = NaN;
  private envelopes: Envelope[] = [];
  private source: SampleRing | null = null;

  constructor(private readonly channels: readonly string[]) {
    this.ys = channels.map(() => []);
  }

  /**
   * Fills x and ys with the newest `window_s` of the ring, reusing its arrays.
   * @param pixels width of the plot in device pixels; @param shown which series count for the y range.
   */
  update(
    ring: SampleRing,
    window_s: number,
    period_s: number,
    pixels: number,
    shown: readonly boolean[],
  ): void {
    const windowTicks = Math.round(window_s / period_s);
    const from = Math.max(ring.firstTick, ring.endTick - windowTicks);
    this.bucket = bucketTicks(windowTicks, Math.floor(pixels));
    if (this.bucket === 1) this.everySample(ring, from, period_s);
    else this.everyColumn(ring, from, period_s, Math.ceil(windowTicks / this.bucket) + 2);
    this.measure(shown);
  }

  private everySample(ring: SampleRing, from: number, period_s: number): void {
    const samples = ring.endTick - from;
    this.x.length = samples;
    for (let i = 0; i < samples; i += 1) this.x[i] = (i + 1 - samples) * period_s;
    this.channels.forEach((channel, series) => {
      const values = ring.column(channel);
      const y = this.ys[series]!;
      y.length = samples;
      for (let i = 0; i < samples; i += 1) y[i] = known(values?.[(from + i) % ring.capacity]);
    });
  }

  private everyColumn(ring: SampleRing, from: number, period_s: number, columns: number): void {
    this.keepEnvelopes(ring, columns);
    const firstColumn = Math.floor(from / this.bucket);
    const used = Math.max(0, Math.ceil(ring.endTick / this.bucket) - firstColumn);
    const newest = ring.endTick - 1;
    this.x.length = 2 * used;
    for (let i = 0; i < used; i += 1) {
      const start = (firstColumn + i) * this.bucket - newest;
      this.x[2 * i] = (start + 0.25 * this.bucket) * period_s;
      this.x[2 * i + 1] = (start + 0.75 * this.bucket) * period_s;
    }
    this.envelopes.forEach((envelope, series) => {
      envelope.update(ring);
      const y = this.ys[series]!;
      y.length = 2 * used;
      for (let i = 0; i < used; i += 1) {
        y[2 * i] = known(envelope.firstOf(firstColumn + i));
        y[2 * i + 1] = known(envelope.secondOf(firstColumn + i));
      }
    });
  }

  private keepEnvelopes(ring: SampleRing, columns: number): void {
    const [sample] = this.envelopes;
    if (this.source === ring && sample?.bucket === this.bucket && sample.columns === columns) return;
    this.source = ring;
    this.envelopes = this.channels.map((channel) => new Envelope(channel, this.bucket, columns));
  }

  private measure(shown: readonly boolean[]): void {
    let low = Infinity;
    let high = -Infinity;
    this.ys.forEach((y, series) => {
      if (!shown[series]) return;
      for (const value of y) {
        if (value === null) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    });
    this.low = low <= high ? low : NaN;
    this.high = low <= high ? high : NaN;
  }
}

function known(value: number | undefined): number | null {
  return value === undefined || Number.isNaN(value) ? null : value;
}
