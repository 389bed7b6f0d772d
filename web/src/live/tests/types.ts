// What the library of tests says and takes, under the names of this page. Generated from the backend.

import type { components } from "../../gen/api";
import type { Json } from "./tree";

type Schemas = components["schemas"];
/** A definition is plain data: more than the schema of an answer says. */
type Defined<T> = Omit<T, "definition"> & { readonly definition: Definition };

export type Definition = { readonly [key: string]: Json };
/** Exactly one of both. */
export type TestText = { readonly definition: Definition } | { readonly yaml: string };

/** What is wrong: at which key and line, and what would be right. */
export type Fault = Schemas["ProblemOut"];
export type Outline = Schemas["Outline"];
export type TimedOutline = Pick<Schemas["BlockOutline"], "index" | "start_s" | "duration_s">;
export type Checked = Omit<Schemas["TestChecked"], "definition" | "whole"> & {
  readonly definition?: Definition | null;
  readonly whole?: Definition | null;
};
export type Preview = Schemas["PreviewOut"];
export type CatalogueEntry = Schemas["TestSummary"];
export type TestDetail = Defined<Schemas["TestDetail"]>;
export type Revision = Schemas["RevisionSummary"];
export type Change = Pick<Schemas["ChangeOut"], "path" | "kind"> & { readonly before?: unknown; readonly after?: unknown };
export type Difference = Schemas["Difference"];
export type Layer = Schemas["Layer"];
export type Spectrum = Schemas["SpectrumOut"];
export type HistoryFile = Schemas["HistoryInfo"];
export type Imported = Schemas["Imported"];
