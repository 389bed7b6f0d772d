// Modes in words, and which of them are abnormal.

import type { Freshness } from "./freshness";
import type { Mode, RigStatus } from "./types";

const MODES: Record<Mode, string> = {
  tripped: "Tripped",
  off: "Off",
  pressurising: "Pressurising",
  ready: "Ready",
  running: "Running",
  holding: "Holding",
  stopping: "Stopping",
  starting: "Starting",
  lost: "Loop lost",
};

export interface ModeWords {
  readonly text: string;
  readonly tone: "plain" | "active" | "trip" | "stale";
}

const ACTIVE: ReadonlySet<Mode> = new Set(["pressurising", "running", "holding", "stopping"]);

/** What the mode field says. A mode that is no longer known is not shown. */
export function modeWords(status: RigStatus | null, fresh: Freshness): ModeWords {
  if (fresh.trouble === "connecting") return { text: "Connecting", tone: "stale" };
  if (fresh.trouble === "link") return { text: "Link lost", tone: "stale" };
  if (fresh.trouble === "starting") return { text: MODES.starting, tone: "stale" };
  if (fresh.trouble === "loop" || status === null) return { text: MODES.lost, tone: "stale" };
  const tone = status.mode === "tripped" ? "trip" : ACTIVE.has(status.mode) ? "active" : "plain";
  return { text: MODES[status.mode] ?? status.mode, tone: status.mode === "lost" ? "stale" : tone };
}
