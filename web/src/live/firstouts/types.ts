// First-outs as the server says them. Times are seconds from the first-out.

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
  readonly settings: { readonly interlocks: { readonly detectors: readonly KeptDetector[] } | null };
  readonly injected: Readonly<Record<string, number>>;
}

/** What of a kept detector is needed here. */
export interface KeptDetector {
  readonly name: string;
  readonly quantity: string;
  readonly form?: string;
  readonly comparison: string;
  readonly threshold: number;
  readonly low?: number | null;
  readonly enabled?: boolean;
  readonly persistence_s?: number;
}
