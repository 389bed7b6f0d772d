// Requests about frequency responses and analyses: an answer, or how far it is.

import { request } from "../api";
import type { Computing } from "../types";
import type { Analysis, FrequencyResponse, TransferName } from "./types";

const WAIT_S = 2;

export const frequencyResponse = (
  id: number,
  transfer: TransferName,
  signal?: AbortSignal,
): Promise<FrequencyResponse | Computing> =>
  request(`runs/${id}/frequency-response?transfer=${transfer}&wait_s=${WAIT_S}`, signal ? { signal } : {});

export const runAnalysis = (id: number, signal?: AbortSignal): Promise<Analysis | Computing> =>
  request(`runs/${id}/analysis?wait_s=${WAIT_S}`, signal ? { signal } : {});

export const isComputing = (answer: object): answer is Computing => "share" in answer;
