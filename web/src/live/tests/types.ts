// What the library of tests says and takes.

import type { Json } from "./tree";

export type Definition = { readonly [key: string]: Json };

export interface Fault {
  readonly path: string;
  readonly value: unknown;
  readonly message: string;
  readonly limit: number | null;
  readonly unit: string | null;
  /** Line of the YAML, from 1; null where there is no text. */
  readonly line: number | null;
}

export interface TimedOutline {
  readonly index: number;
  readonly kind: string;
  readonly start_s: number;
  readonly duration_s: number;
  readonly cycles: number;
}

export interface Outline {
  readonly blocks: readonly TimedOutline[];
  readonly motion: readonly TimedOutline[];
  readonly duration_s: number;
  readonly motion_duration_s: number;
  readonly cycles: number;
  readonly peak_force_n: number;
  readonly peak_displacement_m: number;
}

/** Exactly one of both. */
export type TestText = { readonly definition: Definition } | { readonly yaml: string };

export interface Checked {
  readonly valid: boolean;
  readonly problems: readonly Fault[];
  readonly definition: Definition | null;
  readonly yaml: string | null;
  readonly outline: Outline | null;
}

export interface Preview {
  readonly duration_s: number;
  readonly from_s: number;
  readonly to_s: number;
  readonly decimated: boolean;
  readonly time_s: readonly number[];
  readonly force_min_n: readonly number[];
  readonly force_max_n: readonly number[];
  readonly displacement_min_m: readonly number[];
  readonly displacement_max_m: readonly number[];
  readonly block: readonly number[];
  readonly peaks: Readonly<Record<string, number | null>>;
  readonly outline: Outline;
}

export interface CatalogueEntry {
  readonly id: string;
  readonly name: string;
  readonly description: string;
  readonly duration_s: number;
  readonly peak_force_n: number;
  readonly blocks: number;
  readonly revision: number;
  readonly tags: readonly string[];
  readonly archived: boolean;
  readonly updated_at: string;
  readonly author: string;
  readonly runs: number;
  readonly last_run_at: string | null;
}

export interface TestDetail extends CatalogueEntry {
  readonly definition: Definition;
  readonly yaml: string;
  /** Null where an old revision is no valid test any more. */
  readonly outline: Outline | null;
  readonly comment: string;
  readonly created_at: string;
}

export interface Revision {
  readonly number: number;
  readonly author: string;
  readonly comment: string;
  readonly created_at: string;
}

export interface Change {
  readonly path: string;
  readonly before?: unknown;
  readonly after?: unknown;
  readonly kind: string;
}

export interface Difference {
  readonly from: number;
  readonly to: number;
  readonly changes: readonly Change[];
  /** Unified difference of the YAML. */
  readonly text: string;
}

export interface Layer {
  readonly mean_n: number;
  readonly amplitude_n: number;
  readonly frequency_hz: number;
  readonly cycles: number;
}

export interface Spectrum {
  readonly layers: readonly Layer[];
  readonly problems: readonly Fault[];
}

export interface HistoryFile {
  readonly file: string;
  readonly samples: number;
  readonly rate_hz: number;
  readonly duration_s: number;
  readonly min: number;
  readonly max: number;
  readonly bandwidth_hz: number | null;
}

export interface Imported {
  readonly imported: readonly { readonly name: string; readonly id: string; readonly action: string }[];
}
