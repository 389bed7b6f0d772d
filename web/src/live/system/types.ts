// What the System page shows, under the names it uses. Generated from the backend (`make gen`).

import type { components } from "../../gen/api";

type Schemas = components["schemas"];

export type Scope = Schemas["Scope"];
/** Each includes those before it. */
export const SCOPES = ["read", "operate", "engineer", "admin"] as const satisfies readonly Scope[];

export type User = Schemas["UserOut"];
export type UserChange = Schemas["UserChange"];
export type Token = Schemas["TokenOut"];
export type MadeToken = Schemas["TokenMade"];
export type SignedIn = Schemas["SessionOut"];
export type SignInLink = Schemas["Link"];
export type AuditEntry = Schemas["AuditEntry"];
export type AuditPage = Schemas["AuditPage"];
export type Verification = Schemas["Verification"];
export type Histogram = Schemas["Histogram"];
export type LoopTiming = Schemas["LoopTiming"];
export type Diagnosis = Schemas["Diagnosis"];
export type About = Schemas["About"];
