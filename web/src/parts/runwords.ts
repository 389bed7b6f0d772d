// How runs end, in words, and which endings are abnormal.

import type { Run } from "../live/types";

export interface Word {
  readonly text: string;
  readonly tone: "plain" | "bad" | "active";
}

export const OUTCOMES: Record<string, Word> = {
  completed: { text: "Completed", tone: "plain" },
  stopped: { text: "Stopped", tone: "plain" },
  tripped: { text: "Tripped", tone: "bad" },
  failed: { text: "Failed", tone: "bad" },
  interrupted: { text: "Interrupted", tone: "bad" },
};
export const VERDICTS: Record<string, Word> = {
  pass: { text: "Pass", tone: "plain" },
  fail: { text: "Fail", tone: "bad" },
  unset: { text: "Unset", tone: "plain" },
};

export function outcomeOf(run: Run): Word {
  if (run.outcome === null) return { text: "Under way", tone: "active" };
  return OUTCOMES[run.outcome] ?? { text: run.outcome, tone: "plain" };
}

export function verdictOf(run: Run): Word {
  if (run.outcome === null) return { text: "", tone: "plain" };
  return VERDICTS[run.verdict ?? "unset"] ?? { text: run.verdict ?? "", tone: "plain" };
}
