// Requests to /api/v1. Refusals are RFC 9457 problem documents; every failure becomes a `Problem` with a sentence.

import { badge, withBadge } from "./access/badge";
import type { RunEntry } from "./entry.svelte";
import type {
  ResumePreview,
  RigCommand,
  RigEvent,
  Run,
  RunDetail,
  RunEvents,
  RunSamples,
  TestSummary,
} from "./types";

export class Problem extends Error {
  constructor(
    readonly detail: string,
    readonly code: string,
    readonly status: number | null,
    /** The whole problem document, for whoever can show more of it than its sentence. */
    readonly document: Readonly<Record<string, unknown>> = {},
  ) {
    super(detail);
  }
}

const NO_ANSWER = "The server does not answer.";
const NOT_SIGNED_IN = "not_signed_in";
const WAIT_MS = 15_000;
const START_WAIT_MS = 40_000;

export async function request<T>(path: string, options: RequestInit = {}): Promise<T> {
  let response: Response;
  try {
    response = await fetch(`/api/v1/${path}`, {
      signal: AbortSignal.timeout(WAIT_MS),
      ...options,
      headers: withBadge(options.method, options.headers),
    });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new Problem(NO_ANSWER, "no_answer", null);
  }
  if (!response.ok) {
    const refusal = await problem(response);
    if (refusal.code === NOT_SIGNED_IN) badge.refused();
    throw refusal;
  }
  return (response.status === 204 ? undefined : await response.json()) as T;
}

async function problem(response: Response): Promise<Problem> {
  const body = (await response.json().catch(() => ({}))) as {
    detail?: unknown;
    title?: unknown;
    code?: unknown;
  } & Record<string, unknown>;
  const sentence = [body.detail, body.title].find((text) => typeof text === "string" && text !== "");
  return new Problem(
    (sentence as string | undefined) ?? `The server refused (${response.status} ${response.statusText}).`,
    typeof body.code === "string" ? body.code : `http_${response.status}`,
    response.status,
    body,
  );
}

export const post = (body: unknown): RequestInit => ({
  method: "POST",
  headers: { "Content-Type": "application/json", Accept: "application/json" },
  body: JSON.stringify(body),
});

export const listTests = (): Promise<TestSummary[]> => request("tests");

/** Starts a run. The server may have to predict first: it is waited for longer than for other answers. */
export const startRun = (
  test_id: string,
  more: RunEntry & { revision?: number; lease?: number },
): Promise<Run> =>
  request("runs", { ...post({ test_id, ...more }), signal: AbortSignal.timeout(START_WAIT_MS) });

export const resumePreview = (): Promise<ResumePreview> => request("rig/resume");

/** Gives a command under the epoch of the control that this window holds. */
export const sendCommand = (
  command: RigCommand,
  lease: number | undefined,
  options: RequestInit = {},
): Promise<unknown> => request("rig/commands", { ...post({ command, lease }), ...options });

export const getRun = (id: number): Promise<RunDetail> => request(`runs/${id}`);

export const listRunEvents = async (id: number): Promise<readonly RigEvent[]> =>
  (await request<RunEvents>(`runs/${id}/events`)).events;

/** The samples of a run between two times, as extremes of at most `points` columns, or single ticks where they fit. */
export function runSamples(
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
  return request(`runs/${id}/samples?${query}`, { signal });
}

export const runDataUrl = (id: number): string => `/api/v1/runs/${id}/data.parquet`;
