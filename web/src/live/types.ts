// What the backend says, under the names this console uses. Everything is generated from the backend (`make gen`).

import type { components } from "../gen/api";

type Schemas = components["schemas"];

export type Mode = Schemas["ModeWord"];
export type RigStatus = Schemas["RigStatus"] & {
  readonly lease?: Lease | null;
  readonly chain?: { readonly closed: boolean };
  readonly stop_url?: string;
  readonly injected?: readonly string[];
};
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
export type Verdict = Schemas["PredictionVerdict"];
export type Prediction = Schemas["Prediction"];
export type Margin = Schemas["Margin"];
export type Computing = Schemas["Computing"];
export type RunMeasurements = Schemas["RunMeasurements"];
export type Criterion = Schemas["JudgedCriterion"];
export type AcquisitionInfo = Schemas["AcquisitionSummary"];
export type Acquisition = Schemas["AcquisitionRows"];
export type Permissive = Schemas["Permissive"];
export type ResumePreview = Schemas["ResumePreview"];
export type PredictedBands = Schemas["PredictedBands"];

/** Who is in command. */
export interface Lease {
  readonly epoch: number;
  readonly holder: string;
  readonly holder_id: string;
  readonly role: string;
  readonly since: string;
  readonly reason: string;
  readonly expires_in_s: number;
  readonly requests: readonly { readonly id: number; readonly name: string; readonly reason: string; readonly since: string }[];
}
