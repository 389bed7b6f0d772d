// Requests about recorded runs: the book, and what belongs to one run.

import { request } from "./api";
import type {
  Acquisition,
  AcquisitionInfo,
  PredictedBands,
  Prediction,
  RunDetail,
  RunMeasurements,
  RunPage,
} from "./types";

const JSON_HEADERS = { "Content-Type": "application/json", Accept: "application/json" };

/** @param query of the filters, as `apiQuery` makes it. */
export const listRuns = (query: string, before: number | null, signal: AbortSignal, limit = 50): Promise<RunPage> =>
  request(`runs?limit=${limit}${before === null ? "" : `&before=${before}`}${query === "" ? "" : `&${query}`}`, {
    signal,
  });

export interface Annotation {
  readonly notes: string;
  readonly tags: readonly string[];
  readonly operator: string;
}

/** Saves notes, tags and operator over the edit one has seen; another's edit in between is a 409. */
export const annotate = (id: number, changes: Partial<Annotation>, annotation: number): Promise<RunDetail> =>
  request(`runs/${id}`, {
    method: "PATCH",
    headers: JSON_HEADERS,
    body: JSON.stringify({ ...changes, annotation }),
  });

export const runTags = (): Promise<readonly string[]> => request("runs/tags");
export const runOperators = (): Promise<readonly string[]> => request("runs/operators");
export const runMeasurements = (id: number): Promise<RunMeasurements> => request(`runs/${id}/measurements`);
export const runPrediction = (id: number): Promise<Prediction> => request(`runs/${id}/prediction`);
export const runAcquisitions = (id: number): Promise<readonly AcquisitionInfo[]> => request(`runs/${id}/acquisitions`);
export const runAcquisition = (id: number, index: number): Promise<Acquisition> =>
  request(`runs/${id}/acquisitions/${index}`);
export const acquisitionCsvUrl = (id: number, index: number): string =>
  `/api/v1/runs/${id}/acquisitions/${index}.csv`;

/** What was predicted of force and displacement, over the run's own time. */
export const runPredicted = (
  id: number,
  from_s: number,
  to_s: number,
  points: number,
  signal: AbortSignal,
): Promise<PredictedBands> =>
  request(`runs/${id}/predicted?from_s=${from_s}&to_s=${to_s}&points=${points}`, { signal });
