// Runs that are compared, under the backend's names.

import type { components } from "../../gen/api";

type Schemas = components["schemas"];

export type Comparison = Schemas["RunComparison"];
export type ComparedRun = Schemas["ComparedRun"];
export type Overlay = Schemas["OverlayOut"];
export type ComparedChannel = Schemas["ComparedChannel"];
export type MeasurementRow = Schemas["MeasurementRow"];
export type SettingRow = Schemas["SettingRow"];
export type Trend = Schemas["Trend"];
export type Align = Schemas["Align"];
export type AnalysisOfRun = Schemas["RunAnalysis"];
