// Asking for comparisons and trends.

import { request } from "../api";
import type { Computing } from "../types";
import type { Comparison, Trend } from "./types";

const WAIT_MS = 30_000;

/** Runs beside one another; how far that is where it takes long. */
export function compareRuns(asked: string, signal: AbortSignal): Promise<Comparison | Computing> {
  return request(`runs/compare?${asked}`, { signal: AbortSignal.any([signal, AbortSignal.timeout(WAIT_MS)]) });
}

/** A measurement over the runs of a test. */
export function getTrend(measurement: string, testId: string, signal: AbortSignal): Promise<Trend> {
  return request(`runs/trend?${new URLSearchParams({ measurement, test_id: testId })}`, { signal });
}
