// Requests to /api/v1/controller.

import { post, request } from "../api";
import type { Checked, InForce, Load, Preview, Revision, RevisionSummary, SettingsChange, Settings } from "./types";

const FROM_HZ = 1;
const TO_HZ = 400;
const POINTS = 160;

export const getController = (): Promise<InForce> => request("controller");
export const getRevision = (number: number): Promise<Revision> => request(`controller/revisions/${number}`);
export const listRevisions = (): Promise<readonly RevisionSummary[]> => request("controller/revisions");
export const getDifference = (from: number, to: number): Promise<{ readonly changes: readonly SettingsChange[] }> =>
  request(`controller/difference?from=${from}&to=${to}`);

export interface Saving {
  readonly why: string;
  readonly based_on: number;
  /** The epoch of the control that this window holds. */
  readonly lease: number | undefined;
}

export const putInForce = (document: Settings, how: Saving): Promise<InForce> =>
  request("controller", { ...post({ document, ...how }), method: "PUT" });
export const restoreRevision = (number: number, how: Saving): Promise<InForce> =>
  request(`controller/revisions/${number}/restore`, post(how));

/** What is wrong with settings, what they change, their loop and their branch. */
export const check = (document: Settings, { amplitude_n, load_hz, tune_hz }: Load, signal: AbortSignal): Promise<Checked> =>
  request("controller/check", {
    ...post({
      document,
      loop: { from_hz: FROM_HZ, to_hz: TO_HZ, points: POINTS },
      compensator: { from_hz: 0.3, to_hz: TO_HZ, points: POINTS, amplitude_n, load_hz, tune_hz },
    }),
    signal,
  });

export const tryOut = (document: Settings, test_id: string): Promise<Preview> =>
  request("controller/preview", post({ document, test_id }));
export const getPreview = (id: string): Promise<Preview> => request(`controller/previews/${id}`);
export const giveUp = (id: string): Promise<Preview> => request(`controller/previews/${id}`, { method: "DELETE" });
