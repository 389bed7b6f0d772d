// One question at a time: a newer one ends the one before it, and only the newest answer counts.

export class Latest {
  private asked: AbortController | null = null;
  private timer = 0;

  /** Asks after a pause; whatever was asked before is given up. Its promise may never settle: nobody waits for it. */
  ask(pause_ms: number, question: (signal: AbortSignal) => Promise<void>): void {
    this.cancel();
    this.timer = window.setTimeout(() => void this.now(question), pause_ms);
  }

  /** Asks at once. */
  async now(question: (signal: AbortSignal) => Promise<void>): Promise<void> {
    this.cancel();
    const asked = new AbortController();
    this.asked = asked;
    await question(asked.signal);
    if (this.asked === asked) this.asked = null;
  }

  cancel(): void {
    window.clearTimeout(this.timer);
    this.asked?.abort();
    this.asked = null;
  }
}
