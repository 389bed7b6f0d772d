// Tells the newest of what changes fast, one request at a time: what is passed over meanwhile is never asked for.

export class Follower<T> {
  private waiting: { readonly value: T } | null = null;
  private busy = false;

  /** @param tell never rejects. @param pause_ms between two of them. */
  constructor(
    private readonly tell: (value: T) => Promise<void>,
    private readonly pause_ms: number,
    private readonly later: (then: () => void, ms: number) => void = (then, ms) => void setTimeout(then, ms),
  ) {}

  follow(value: T): void {
    this.waiting = { value };
    if (!this.busy) void this.next();
  }

  private async next(): Promise<void> {
    if (this.waiting === null) return;
    const { value } = this.waiting;
    this.waiting = null;
    this.busy = true;
    await this.tell(value);
    this.later(() => {
      this.busy = false;
      void this.next();
    }, this.pause_ms);
  }
}
