// The table of detectors as the server says and takes it.

import type { components } from "../../gen/api";

export type { Fault } from "../tests/types";

type Schemas = components["schemas"];
export type QuantityName = Schemas["Detector"]["quantity"];
export type Form = "value" | "rate" | "look_ahead";
export type Comparison = "magnitude_above" | "above" | "below" | "outside";
export type Action = "indicate" | "hold" | "stop" | "shutdown";
export type DetectorMode = "tripped" | "off" | "pressurising" | "ready" | "running" | "holding" | "stopping";

export interface Detector {
  readonly name: string;
  readonly quantity: QuantityName;
  readonly form: Form;
  readonly comparison: Comparison;
  readonly threshold: number;
  readonly low: number | null;
  readonly persistence_s: number;
  readonly horizon_s: number | null;
  readonly smoothing_s: number | null;
  readonly action: Action;
  readonly armed: readonly DetectorMode[];
  readonly latching: boolean;
  readonly enabled: boolean;
  readonly text: string;
}

export type DetectorState = "off" | "not_armed" | "content" | "counting" | "tripped";

/** What a detector sees; `value` is null where that is no number. */
export interface LiveDetector {
  readonly name: string;
  readonly value: number | null;
  readonly margin_share: number | null;
  readonly violated_s: number;
  readonly state: DetectorState;
  readonly first_out: boolean;
  readonly trips: number;
}

export interface LiveInterlocks {
  readonly tick: number;
  readonly mode: string;
  readonly detectors: readonly LiveDetector[];
}

export interface RevisionSummary {
  readonly number: number;
  readonly author: string;
  readonly why: string;
  readonly created_at: string;
}

/** What a table says: its detectors, and which of the guarded ones it weakens on purpose. */
export interface TableText {
  readonly detectors: readonly Detector[];
  readonly knowingly_weaker: readonly string[];
}

export interface Revision extends RevisionSummary, TableText {}

/** The table in force. */
export interface InForce extends TableText {
  readonly revision: number;
  readonly author: string;
  readonly why: string;
  readonly created_at: string;
  readonly in_loop: boolean;
  readonly guarded: readonly string[];
}

/** A guarded detector that a table falls short of, and how. */
export interface Weakened {
  readonly detector: string;
  readonly text: string;
}

export interface Checked {
  readonly errors: readonly {
    readonly path: string;
    readonly expected: string;
    readonly value?: unknown;
    readonly limit: number | null;
    readonly unit: string | null;
    readonly line: number | null;
  }[];
  readonly weakened: readonly Weakened[];
}
