// The last samples of every subscribed channel. A sample's place follows from its tick, so time needs no column
// of its own and a lost tick is simply a NaN. Nothing here grows: a fixed window, and gaps leave the list as they leave the window.

export interface Gap {
  readonly fromTick: number;
  readonly toTick: number;
}

export class SampleRing {
  readonly columns: readonly Float32Array[];
  /** Tick after the newest sample; the ring holds [firstTick, endTick). */
  endTick = 0;
  firstTick = 0;
  /** Samples received since the page was opened, over all resets. */
  received = 0;
  /** Goes up whenever older contents became meaningless. */
  generation = 0;
  gaps: Gap[] = [];

  constructor(
    readonly channels: readonly string[],
    readonly capacity: number,
  ) {
    this.columns = channels.map(() => new Float32Array(capacity).fill(NaN));
  }

  /** Samples of a channel, to be read at `tick % capacity`. */
  column(channel: string): Float32Array | undefined {
    return this.columns[this.channels.indexOf(channel)];
  }

  /** Adds consecutive samples. A jump forwards leaves a gap; a jump backwards is another loop: the window starts anew. */
  push(firstTick: number, columns: readonly Float32Array[]): void {
    const samples = columns[0]?.length ?? 0;
    if (samples === 0 || columns.length !== this.columns.length) return;
    const fresh = this.endTick === this.firstTick;
    if (fresh || firstTick < this.endTick || firstTick - this.endTick >= this.capacity)
      this.restart(firstTick);
    else if (firstTick > this.endTick) this.leaveGap(firstTick);

    const skip = Math.max(0, samples - this.capacity);
    columns.forEach((column, i) => this.write(this.columns[i]!, firstTick + skip, column.subarray(skip)));
    this.endTick = firstTick + samples;
    this.firstTick = Math.max(this.firstTick, this.endTick - this.capacity);
    this.received += samples;
    while (this.gaps.length > 0 && this.gaps[0]!.toTick <= this.firstTick) this.gaps.shift();
  }

  /** Ticks inside the window that never arrived. */
  missingTicks(fromTick = this.firstTick): number {
    return this.gaps.reduce(
      (sum, gap) => sum + Math.max(0, gap.toTick - Math.max(gap.fromTick, fromTick)),
      0,
    );
  }

  /** A copy that stands still while the ring runs on. */
  freeze(): SampleRing {
    const copy = new SampleRing(this.channels, this.capacity);
    this.columns.forEach((column, i) => copy.columns[i]!.set(column));
    return Object.assign(copy, {
      endTick: this.endTick,
      firstTick: this.firstTick,
      received: this.received,
      gaps: [...this.gaps],
    });
  }

  private restart(tick: number): void {
    this.endTick = this.firstTick = tick;
    this.gaps = [];
    this.generation += 1;
  }

  private leaveGap(toTick: number): void {
    for (const column of this.columns) this.fillNaN(column, this.endTick, toTick - this.endTick);
    this.gaps.push({ fromTick: this.endTick, toTick });
  }

  private write(ring: Float32Array, tick: number, values: Float32Array): void {
    const at = tick % this.capacity;
    const head = Math.min(values.length, this.capacity - at);
    ring.set(values.subarray(0, head), at);
    if (head < values.length) ring.set(values.subarray(head), 0);
  }

  private fillNaN(ring: Float32Array, tick: number, length: number): void {
    const at = tick % this.capacity;
    ring.fill(NaN, at, Math.min(this.capacity, at + length));
    if (at + length > this.capacity) ring.fill(NaN, 0, at + length - this.capacity);
  }
}
