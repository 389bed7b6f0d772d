// The rig's configuration and its analysis, as the server says them.

import type { components } from "../../gen/api";

type Schemas = components["schemas"];
export type InForce = Schemas["RigConfigurationOut"];
export type Configuration = InForce["document"];
export type Revision = Schemas["RigConfigurationRevisionOut"];
export type RevisionSummary = Schemas["SettingsRevision"];
export type SettingsChange = Schemas["SettingsChange"];
export type CalibrationState = Schemas["CalibrationState"];
export type StaticSheet = Schemas["StaticSheet"];
export type LinearSheet = Schemas["LinearSheet"];
