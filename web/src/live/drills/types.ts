// Drills as the server says them. Times are seconds from the tick in which the loop took the fault.

export interface Reaction {
  /** Which detectors may be the first-out; none where the load must stay on. */
  readonly first_outs: readonly string[];
  readonly within_s: number;
  readonly sees: string;
}

export interface Drill {
  readonly fault: string;
  readonly name: string;
  readonly doc: string;
  /** What the amount means. */
  readonly amount: string;
  readonly unit: string;
  readonly low: number;
  readonly high: number;
  readonly default: number;
  readonly ready: Reaction | null;
  readonly test: Reaction | null;
  readonly why_not: string | null;
}

export interface Catalogue {
  readonly drills: readonly Drill[];
  readonly under_way: number | null;
  readonly injected: Readonly<Record<string, number>>;
}

export interface Expectation {
  readonly name: string;
  readonly met: boolean;
  readonly text: string;
}

export interface Peak {
  readonly channel: string;
  readonly unit: string;
  readonly value: number | null;
  readonly limit: number | null;
  readonly after_s: number | null;
}

export interface Score {
  readonly first_out: string | null;
  readonly action: string | null;
  readonly reaction_ticks: number | null;
  readonly safe_ticks: number | null;
  readonly mode_after: string;
  readonly peaks: readonly Peak[];
  readonly expectations: readonly Expectation[];
}

export interface DrillSummary {
  readonly id: number;
  readonly fault: string;
  readonly amount: number;
  /** under_way, passed, failed or interrupted. */
  readonly state: string;
  readonly mode_before: string;
  readonly given_by: string;
  readonly given_at: string;
  readonly ended_at: string | null;
  readonly run_id: number | null;
  readonly first_out: string | null;
  readonly reaction_ticks: number | null;
  readonly why: string | null;
}

export interface DrillPage {
  readonly records: readonly DrillSummary[];
  readonly next: number | null;
}

export interface DrillDetail extends DrillSummary {
  readonly period_s: number;
  readonly tick: number | null;
  readonly expected: Reaction | null;
  readonly score: Score | null;
  readonly first_s: number | null;
  readonly last_s: number | null;
}
