// What the backend says, under the names this console uses. Everything is generated from the backend (`make gen`).

import type { components } from "../gen/api";

type Schemas = components["schemas"];

export type Mode = Schemas["ModeWord"];
export type RigStatus = Schemas["RigStatus"];
export type Trip = Schemas["Trip"];
export type LoopHealth = Schemas["LoopHealth"];
export type RigEvent = Schemas["EventOut"];
export type Hello = Schemas["Hello"];

/** Commands that go to `POST /api/v1/rig/commands`. */
export type RigCommand = Schemas["RigCommand"];
/** Everything that `status.commands` speaks of: starting a run is its own request. */
export type Command = keyof Schemas["CommandReasons"];

export type ServerMessage =
  Hello | Schemas["StatusFrame"] | Schemas["EventFrame"] | Schemas["RunsChanged"] | Schemas["ErrorFrame"];

export type TestSummary = Schemas["TestSummary"];
export type Run = Schemas["RunSummary"];
export type RunDetail = Schemas["RunDetail"];
export type RunPage = Schemas["RunPage"];
export type RunEvents = Schemas["RunEvents"];
export type RunSamples = Schemas["RunSamples"];

// ---- not generated yet ----

export interface Permissive {
  readonly name: string;
  readonly met: boolean;
  readonly text: string;
}

export type Verdict = "clear" | "caution" | "refused";

export interface PredictionReason {
  readonly code: string;
  readonly text: string;
  readonly severity: "caution" | "refused";
  readonly block: number | null;
  readonly time_s: number | null;
}

export interface Margin {
  readonly detector: string;
  readonly quantity: string;
  readonly unit: string;
  readonly threshold: number | null;
  readonly extreme: number | null;
  readonly margin: number | null;
  readonly margin_share: number | null;
  readonly time_s: number | null;
  readonly block: number | null;
  readonly action: string;
  readonly predicted: boolean;
}

export interface Prediction {
  readonly verdict: Verdict;
  readonly reasons: readonly PredictionReason[];
  readonly duration_s: number;
  readonly predicted_s: number;
  readonly shortened: readonly { readonly path: string; readonly text: string }[];
  readonly margins: readonly Margin[];
  readonly valve: {
    readonly peak: number;
    readonly saturation_share: number;
    readonly longest_saturation_s: number;
  };
  readonly peaks: Readonly<Record<string, number | null>>;
  readonly outcome: string;
  readonly computed_in_s: number;
  readonly speed: number;
}

export interface Computing {
  readonly state: "computing";
  readonly share: number;
  readonly seconds_left: number | null;
}

export interface ResumePreview {
  readonly time_s: readonly number[];
  readonly force_min_n: readonly number[];
  readonly force_max_n: readonly number[];
  readonly displacement_min_m: readonly number[];
  readonly displacement_max_m: readonly number[];
  readonly block: number;
  readonly cycle: number;
  readonly text: string;
}

export interface Criterion {
  readonly measurement: string;
  readonly block?: number | null;
  readonly unit: string;
  readonly value: number | null;
  readonly at_least: number | null;
  readonly at_most: number | null;
  readonly outcome: string;
}

export interface Measurement {
  readonly name: string;
  readonly unit: string;
  readonly value: number | null;
}

export interface RunMeasurements {
  readonly verdict: string;
  readonly criteria: readonly Criterion[];
  readonly blocks: readonly {
    readonly block: number;
    readonly kind: string;
    readonly measurements: readonly Measurement[];
  }[];
  readonly run: readonly Measurement[];
}

export interface AcquisitionInfo {
  readonly index: number;
  readonly kind: string;
  readonly title: string;
  readonly rows: number;
  readonly columns: readonly string[];
}

export interface Acquisition {
  readonly columns: Readonly<Record<string, readonly (number | null)[]>>;
}

export interface PredictedBands {
  readonly time_s: readonly number[];
  readonly force_min_n: readonly (number | null)[];
  readonly force_max_n: readonly (number | null)[];
  readonly displacement_min_m: readonly (number | null)[];
  readonly displacement_max_m: readonly (number | null)[];
}
