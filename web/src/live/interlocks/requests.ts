// Requests to /api/v1/interlocks.

import { post, request } from "../api";
import type { Checked, InForce, LiveInterlocks, Revision, RevisionSummary, TableText } from "./types";

export const getInterlocks = (): Promise<InForce> => request("interlocks");
export const getRevision = (number: number): Promise<Revision> => request(`interlocks/revisions/${number}`);
export const listRevisions = (): Promise<readonly RevisionSummary[]> => request("interlocks/revisions");

export const liveInterlocks = (signal: AbortSignal): Promise<LiveInterlocks> => request("interlocks/live", { signal });

export const checkTable = (table: TableText, signal: AbortSignal): Promise<Checked> =>
  request("interlocks/check", { ...post(table), signal });

export interface Saving {
  readonly why: string;
  readonly based_on: number;
  /** The epoch of the control that this window holds. */
  readonly lease: number | undefined;
}

export const saveTable = (table: TableText, how: Saving): Promise<InForce> =>
  request("interlocks", { ...post({ ...table, ...how }), method: "PUT" });
