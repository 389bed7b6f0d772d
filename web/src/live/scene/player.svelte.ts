// Walks through a recorded run at a pace at which its motion can be seen: 50 Hz is a blur in real time.

export const PACES = [1, 0.1, 0.01] as const;
export type Pace = (typeof PACES)[number];
const STEP_MS = 80;

export class Player {
  time_s = $state(0);
  pace = $state<Pace>(0.1);
  playing = $state(false);
  private timer = 0;

  /** @param duration_s of the run that is walked through. */
  constructor(private readonly duration_s: () => number) {}

  toggle(): void {
    if (this.playing) return this.pause();
    if (this.time_s >= this.duration_s()) this.time_s = 0;
    this.playing = true;
    this.timer = window.setInterval(() => this.step(), STEP_MS);
  }

  pause(): void {
    this.playing = false;
    window.clearInterval(this.timer);
  }

  seek(time_s: number): void {
    this.time_s = Math.min(Math.max(0, time_s), this.duration_s());
  }

  private step(): void {
    this.seek(this.time_s + 1e-3 * STEP_MS * this.pace);
    if (this.time_s >= this.duration_s()) this.pause();
  }
}
