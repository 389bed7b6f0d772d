// Requests to /api/v1/rig-configuration, and to the analysis of what is in force.

import { post, request } from "../api";
import type { Configuration, InForce, LinearSheet, Revision, RevisionSummary, SettingsChange, StaticSheet } from "./types";

export const getConfiguration = (): Promise<InForce> => request("rig-configuration");
export const getRevision = (number: number): Promise<Revision> => request(`rig-configuration/revisions/${number}`);
export const listRevisions = (): Promise<readonly RevisionSummary[]> => request("rig-configuration/revisions");
export const getDifference = (from: number, to: number): Promise<{ readonly changes: readonly SettingsChange[] }> =>
  request(`rig-configuration/difference?from=${from}&to=${to}`);

export interface Saving {
  readonly why: string;
  readonly based_on: number;
  /** The epoch of the control that this window holds. */
  readonly lease: number | undefined;
}

export const putInForce = (document: Configuration, how: Saving): Promise<InForce> =>
  request("rig-configuration", { ...post({ document, ...how }), method: "PUT" });

/** @param diameters_m of bypass orifices; without any, that of the rig. */
export const analyseStatic = (diameters_m: readonly number[]): Promise<StaticSheet> =>
  request(
    `analysis/static?${new URLSearchParams([["points", "401"], ...diameters_m.map((d) => ["orifice_diameter_m", String(d)])])}`,
  );

/** @param load_hz puts the compensation into the loop. @param to_hz peak and dip are sought below. */
export function analyseLinear(mean_n: number, load_hz: number | null, to_hz: number): Promise<LinearSheet> {
  const query = new URLSearchParams({ mean_n: String(mean_n), to_hz: String(to_hz), ...(load_hz === null ? {} : { load_hz: String(load_hz) }) });
  return request(`analysis/linear?${query}`);
}
