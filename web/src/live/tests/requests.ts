// Requests to /api/v1/tests and /api/v1/histories.

import { post, request } from "../api";
import type { Computing, Prediction } from "../types";
import type {
  CatalogueEntry,
  Checked,
  Difference,
  HistoryFile,
  Imported,
  Preview,
  Revision,
  Spectrum,
  TestDetail,
  TestText,
} from "./types";

const at = (id: string): string => `tests/${encodeURIComponent(id)}`;
const put = (body: unknown): RequestInit => ({ ...post(body), method: "PUT" });

export const listCatalogue = (archived: boolean): Promise<CatalogueEntry[]> =>
  request(`tests?archived=${archived}&limit=1000`);

export const getTest = (id: string): Promise<TestDetail> => request(at(id));
export const getRevision = (id: string, number: number): Promise<TestDetail> =>
  request(`${at(id)}/revisions/${number}`);
export const listRevisions = (id: string): Promise<Revision[]> => request(`${at(id)}/revisions`);
export const getDifference = (id: string, from: number, to: number): Promise<Difference> =>
  request(`${at(id)}/difference?from=${from}&to=${to}`);

export const checkTest = (text: TestText, signal: AbortSignal): Promise<Checked> =>
  request("tests/check", { ...post(text), signal });

export interface PreviewWindow {
  readonly from_s?: number;
  readonly to_s?: number;
  readonly points: number;
}

export const previewTest = (text: TestText, shown: PreviewWindow, signal: AbortSignal): Promise<Preview> =>
  request("tests/preview", { ...post({ ...text, ...shown }), signal });

export const readSpectrum = (text: string): Promise<Spectrum> => request("tests/spectrum", post({ text }));

export interface Saving {
  readonly comment: string;
  readonly author: string;
  readonly tags?: readonly string[];
}

export const createTest = (text: TestText, saving: Saving): Promise<TestDetail> =>
  request("tests", post({ ...text, ...saving }));
export const reviseTest = (
  id: string,
  text: TestText,
  saving: Saving & { readonly based_on: number },
): Promise<TestDetail> => request(at(id), put({ ...text, ...saving }));

export const archiveTest = (id: string): Promise<void> => request(at(id), { method: "DELETE" });
export const restoreTest = (id: string): Promise<unknown> => request(`${at(id)}/restore`, post({}));
export const cloneTest = (id: string, name?: string): Promise<TestDetail> =>
  request(`${at(id)}/clone`, post(name === undefined ? {} : { name }));
export const tagTest = (id: string, tags: readonly string[]): Promise<unknown> =>
  request(`${at(id)}/tags`, put({ tags }));
export const restoreRevision = (id: string, number: number): Promise<TestDetail> =>
  request(`${at(id)}/revisions/${number}/restore`, post({}));

export const libraryUrl = (ids: readonly string[]): string =>
  `/api/v1/tests/library.zip${ids.length === 0 ? "" : `?ids=${ids.map(encodeURIComponent).join(",")}`}`;
export const definitionUrl = (id: string): string => `/api/v1/${at(id)}/definition.yaml`;

/** Takes over files: one archive as it is, or any number of YAML and JSON texts. All of them or none. */
export async function importFiles(files: readonly File[]): Promise<Imported> {
  const archive = files.length === 1 && /\.zip$/i.test(files[0]!.name) ? files[0] : undefined;
  if (archive) {
    const headers = { "Content-Type": "application/zip", Accept: "application/json" };
    return request("tests/import", { method: "POST", headers, body: archive });
  }
  const texts = await Promise.all(files.map(async (file) => [file.name, await file.text()] as const));
  return request("tests/import", post({ files: Object.fromEntries(texts) }));
}

export const listHistories = (): Promise<HistoryFile[]> => request("histories");

export function uploadHistory(file: File, rate_hz: number | null): Promise<HistoryFile> {
  const query = new URLSearchParams({ name: file.name });
  if (rate_hz !== null) query.set("rate_hz", String(rate_hz));
  const headers = { "Content-Type": "text/csv", Accept: "application/json" };
  const signal = AbortSignal.timeout(10 * 60_000);
  return request(`histories?${query}`, { method: "POST", headers, body: file, signal });
}

const PREDICTION_MS = 60_000;

/** The prediction of what is saved (`id`), or of a text that is not. */
export const predict = (
  asked: { readonly id: string; readonly revision: number } | TestText,
  signal: AbortSignal,
): Promise<Prediction | Computing> => {
  const until = { signal: AbortSignal.any([signal, AbortSignal.timeout(PREDICTION_MS)]) };
  return "id" in asked
    ? request(`${at(asked.id)}/prediction`, { ...post({ revision: asked.revision, wait_s: 1 }), ...until })
    : request("tests/prediction", { ...post({ ...asked, wait_s: 1 }), ...until });
};
