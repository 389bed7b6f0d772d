// What the backend says, under the names this console uses. Everything is generated from the backend (`make gen`).

import type { components } from "../gen/api";

type Schemas = components["schemas"];

export type Mode = Schemas["ModeWord"];
export type RigStatus = Schemas["RigStatus"];
/** Who is in command. */
export type Lease = Schemas["LeaseOut"];
export type Trip = Schemas["Trip"];
export type LoopHealth = Schemas["LoopHealth"];
export type RigEvent = Schemas["EventOut"];
export type Hello = Schemas["Hello"];

/** Commands that go to `POST /api/v1/rig/commands`. */
export type RigCommand = Schemas["RigCommand"];
/** Everything that `status.commands` speaks of: starting a run is its own request. */
export type Command = keyof Schemas["CommandReasons"];

export type ServerMessage =
  | Hello
  | Schemas["StatusFrame"]
  | Schemas["EventFrame"]
  | Schemas["RunsChanged"]
  | Schemas["ResponseFrame"]
  | Schemas["ErrorFrame"];

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
