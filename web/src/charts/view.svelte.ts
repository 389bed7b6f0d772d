// What all live charts share: the window, and whether the picture stands still.

import { live, type LiveSamples } from "../live/samples";

export const WINDOWS_S = [0.2, 1, 5, 20, 60] as const;
export type WindowSeconds = (typeof WINDOWS_S)[number];

class View {
  window_s = $state<WindowSeconds>(5);
  /** A copy of the samples at the moment of the pause; null while the charts run. */
  frozen = $state.raw<LiveSamples | null>(null);

  get paused(): boolean {
    return this.frozen !== null;
  }

  /** Freezes the picture, or lets it run. The data go on either way. */
  togglePause(): void {
    const { ring, period_s } = live();
    this.frozen = this.frozen ? null : { ring: ring.freeze(), period_s };
  }

  /** One window shorter or longer. */
  step(by: -1 | 1): void {
    const at = WINDOWS_S.indexOf(this.window_s) + by;
    this.window_s = WINDOWS_S[Math.min(WINDOWS_S.length - 1, Math.max(0, at))]!;
  }

  samples(): LiveSamples {
    return this.frozen ?? live();
  }
}

export const view = new View();
