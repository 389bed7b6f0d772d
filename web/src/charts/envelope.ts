// Decimation that keeps up: columns that are complete are never looked at again while the window moves on.

import { extremes } from "./decimate";
import type { SampleRing } from "../live/ring";

export class Envelope {
  private readonly first: Float32Array;
  private readonly second: Float32Array;
  /** Columns from here on are not yet complete. */
  private nextColumn = 0;
  private oldestColumn = 0;
  private generation = -1;
  private readonly out = { first: 0, second: 0 };

  /** @param columns how many columns are kept; @param bucket ticks a column. */
  constructor(
    readonly channel: string,
    readonly bucket: number,
    readonly columns: number,
  ) {
    this.first = new Float32Array(columns).fill(NaN);
    this.second = new Float32Array(columns).fill(NaN);
  }

  /** Brings the columns up to the ring's newest sample. */
  update(ring: SampleRing): void {
    const values = ring.column(this.channel);
    if (!values) return;
    const endColumn = Math.ceil(ring.endTick / this.bucket);
    if (this.generation !== ring.generation) {
      this.generation = ring.generation;
      this.nextColumn = this.oldestColumn = Math.floor(ring.firstTick / this.bucket);
    }
    this.oldestColumn = Math.max(this.oldestColumn, endColumn - this.columns);
    for (let column = Math.max(this.nextColumn, this.oldestColumn); column < endColumn; column += 1) {
      const start = column * this.bucket;
      extremes(
        values,
        Math.max(ring.firstTick, start),
        Math.min(ring.endTick, start + this.bucket),
        this.out,
      );
      this.first[column % this.columns] = this.out.first;
      this.second[column % this.columns] = this.out.second;
    }
    this.nextColumn = Math.floor(ring.endTick / this.bucket);
  }

  /** Extremes of a column in time order; NaN where it is outside of what is kept. */
  firstOf(column: number): number {
    return column < this.oldestColumn ? NaN : this.first[column % this.columns]!;
  }

  secondOf(column: number): number {
    return column < this.oldestColumn ? NaN : this.second[column % this.columns]!;
  }
}
