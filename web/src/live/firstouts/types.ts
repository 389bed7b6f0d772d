// First-outs as the server says them. Times are seconds from the first-out.

import type { Detector } from "../interlocks/types";
import type { Json } from "../tests/tree";
import type { RunSamples } from "../types";

export interface FirstOutSummary {
  readonly id: number;
  readonly tripped_at: string;
  readonly detector: string;
  readonly quantity: string;
  readonly action: string;
  readonly text: string;
  readonly value: number | null;
  readonly limit: number | null;
  readonly tick: number;
  readonly mode_before: string | null;
  readonly run_id: number | null;
  /** 0 where nothing of it was kept. */
  readonly ticks: number;
  readonly note: string;
  readonly cause: string;
}

export interface FirstOutPage {
  readonly first_outs: readonly FirstOutSummary[];
  readonly next: number | null;
  readonly trouble: string | null;
}

export interface TripKept {
  readonly order: number;
  readonly tick: number;
  readonly time_s: number;
  readonly detector: string;
  readonly quantity: string;
  readonly action: string;
  readonly text: string;
  readonly value: number | null;
  readonly limit: number | null;
}

export interface EventKept {
  readonly tick: number;
  readonly time_s: number;
  readonly kind: string;
  readonly code: string;
  readonly text: string;
}

export interface PeakKept {
  readonly channel: string;
  readonly unit: string;
  readonly before: number | null;
  readonly after: number | null;
  readonly after_s: number | null;
}

export interface FirstOutDetail extends FirstOutSummary {
  readonly period_s: number;
  readonly first_s: number | null;
  readonly last_s: number | null;
  readonly missing_ticks: number;
  readonly trips: readonly TripKept[];
  readonly events: readonly EventKept[];
  readonly peaks: readonly PeakKept[];
  readonly settings: KeptSettings;
  readonly injected: Readonly<Record<string, number>>;
}

/** A detector that the recording cannot tell of; its recorded trips stand. */
export interface NotReplayed {
  readonly detector: string;
  readonly why: string;
}

/** What trips over the recorded ticks, as it was and with values changed. */
export interface Replayed {
  readonly recorded: readonly TripKept[];
  readonly unchanged: readonly TripKept[];
  readonly changed: readonly TripKept[];
  readonly first_out: TripKept | null;
  readonly reproduces: boolean;
  readonly not_replayed: readonly NotReplayed[];
  readonly text: string;
}

/** What happened, or would have. */
export interface Course {
  readonly trips: readonly TripKept[];
  readonly first_out: TripKept | null;
  readonly peaks: readonly PeakKept[];
  readonly samples: RunSamples | null;
}

/** As recorded, and on the virtual rig without and with one value changed. */
export interface Rerun {
  readonly recorded: Course;
  readonly unchanged: Course;
  readonly changed: Course;
  readonly lead_s: number;
  readonly not_rerun: readonly string[];
  readonly text: readonly string[];
}

/** What was in force, as it was kept. */
export interface KeptSettings {
  readonly controller: { readonly [key: string]: Json };
  readonly rig: { readonly [key: string]: Json };
  readonly interlocks: { readonly detectors: readonly Detector[] } | null;
}
