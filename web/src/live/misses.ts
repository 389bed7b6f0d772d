// Whether the loop missed deadlines lately. Those of its start, long ago, are counted but no reason for colour.

const LATELY_S = 60;

export class Misses {
  private before: number | null = null;
  private roseAt_s = -Infinity;

  /** Takes the loop's count; says whether it has risen within the last minute, as far as this page saw. */
  lately(deadlinesMissed: number, now_s: number): boolean {
    if (this.before !== null && deadlinesMissed > this.before) this.roseAt_s = now_s;
    this.before = deadlinesMissed;
    return now_s - this.roseAt_s < LATELY_S;
  }
}
