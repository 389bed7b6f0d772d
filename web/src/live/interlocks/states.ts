// The state of a detector in words. Pure.

import type { Detector, DetectorState, LiveDetector } from "./types";

const WORDS: Readonly<Record<DetectorState, string>> = {
  content: "Content",
  counting: "Counting",
  tripped: "Tripped",
  off: "Switched off",
  not_armed: "Not armed",
};

/** `Content`; `Counting 32 of 50 ms`: while it counts, how long already. */
export function stateText({ persistence_s }: Pick<Detector, "persistence_s">, live: LiveDetector | null): string {
  if (live === null) return "Not known";
  if (live.state !== "counting") return WORDS[live.state];
  const [scale, unit, digits] = persistence_s < 1 ? [1000, "ms", 0] : [1, "s", 1];
  const [now, whole] = [live.violated_s, persistence_s].map((time_s) => (scale * time_s).toFixed(digits));
  return `${WORDS.counting} ${now} of ${whole}\u00a0${unit}`;
}
