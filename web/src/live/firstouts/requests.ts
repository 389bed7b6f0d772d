// Requests to /api/v1/first-outs.

import { post, request } from "../api";
import type { Json } from "../tests/tree";
import type { Computing, RunSamples } from "../types";
import type { FirstOutDetail, FirstOutPage, Replayed, Rerun } from "./types";

const JSON_HEADERS = { "Content-Type": "application/json", Accept: "application/json" };

export const listFirstOuts = (before: number | null, signal?: AbortSignal): Promise<FirstOutPage> =>
  request(`first-outs?limit=50${before === null ? "" : `&before=${before}`}`, signal ? { signal } : {});

export const getFirstOut = (id: number): Promise<FirstOutDetail> => request(`first-outs/${id}`);

export function firstOutSamples(
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
  return request(`first-outs/${id}/samples?${query}`, { signal });
}

export const annotateFirstOut = (
  id: number,
  changes: { readonly note?: string; readonly cause?: string },
): Promise<FirstOutDetail> =>
  request(`first-outs/${id}`, { method: "PATCH", headers: JSON_HEADERS, body: JSON.stringify(changes) });

export const firstOutDataUrl = (id: number): string => `/api/v1/first-outs/${id}/data.parquet`;

/** Over the recorded ticks with values of detectors changed, each by a path such as `force_error.threshold`. */
export const replayFirstOut = (
  id: number,
  interlocks: Readonly<Record<string, unknown>>,
  signal: AbortSignal,
): Promise<Replayed> => request(`first-outs/${id}/replay`, { ...post({ interlocks }), signal });

export interface RerunAsked {
  readonly change: { readonly path: string; readonly value: Json };
  readonly channels: readonly string[];
  readonly points: number;
  readonly wait_s: number;
}

/** The same once more on the virtual rig, without and with the change; or how far that is. */
export const rerunFirstOut = (id: number, asked: RerunAsked, signal: AbortSignal): Promise<Rerun | Computing> =>
  request(`first-outs/${id}/rerun`, { ...post(asked), signal });
