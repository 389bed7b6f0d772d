// Requests to /api/v1/drills.

import { post, request } from "../api";
import type { RunSamples } from "../types";
import type { Catalogue, DrillDetail, DrillPage } from "./types";

export const listDrills = (): Promise<Catalogue> => request("drills");
export const listRecords = (before: number | null): Promise<DrillPage> =>
  request(`drills/records?limit=50${before === null ? "" : `&before=${before}`}`);
export const getRecord = (id: number): Promise<DrillDetail> => request(`drills/records/${id}`);

/** Gives the simulated rig a fault, under the epoch of the control that this window holds. */
export const giveDrill = (fault: string, amount: number, lease: number | undefined): Promise<DrillDetail> =>
  request("drills", post({ fault, amount, lease }));
export const clearDrills = (lease: number | undefined): Promise<Catalogue> => request("drills/clear", post({ lease }));

export function drillSamples(
  id: number,
  channels: readonly string[],
  from_s: number,
  to_s: number,
  points: number,
  signal: AbortSignal,
): Promise<RunSamples> {
  const query = new URLSearchParams({
    channels: channels.join(","),
    from_s: String(from_s),
    to_s: String(to_s),
    points: String(points),
  });
  return request(`drills/records/${id}/samples?${query}`, { signal });
}
