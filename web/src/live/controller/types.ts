// Controller settings, their analysis and their previews, as the server says them.

import type { components } from "../../gen/api";

type Schemas = components["schemas"];
export type Settings = Schemas["ControllerSettings"];
export type Compensator = Schemas["Compensator"];
export type InForce = Schemas["ControllerOut"];
export type Revision = Schemas["ControllerRevisionOut"];
export type RevisionSummary = Schemas["SettingsRevision"];
export type SettingsChange = Schemas["SettingsChange"];
export type Checked = Schemas["ControllerCheck"];
export type LinearSheet = Schemas["LinearSheet"];
export type CompensatorSheet = Schemas["CompensatorSheet"];
export type LoopAt = Schemas["LoopAt"];
export type Margins = Schemas["MarginsOut"];
export type LoopResponse = Schemas["LoopResponse"];
export type Tuning = Schemas["Tuning"];
export type Preview = Schemas["ControllerPreview"];
export type Previewed = Schemas["Previewed"];
export type PreviewSide = Schemas["PreviewSide"];
export type Fault = Schemas["FaultOut"];

/** Under which load the loop and its compensator are looked at. */
export interface Load {
  readonly amplitude_n: number;
  readonly load_hz: number;
  /** Where to tune the branch exactly. */
  readonly tune_hz: number;
}
