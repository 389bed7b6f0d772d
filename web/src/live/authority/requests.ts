// Requests to /api/v1/lease.

import { post, request } from "../api";

/** What a window needs of the answer: under which epoch it may command. */
export interface Granted {
  readonly epoch: number;
}
export interface Asked {
  readonly id: number;
}

export const takeLease = (reason: string, take_over: boolean): Promise<Granted> =>
  request("lease", post({ reason, take_over }));
export const releaseLease = (): Promise<unknown> => request("lease", { method: "DELETE" });
export const askForLease = (reason: string): Promise<Asked> => request("lease/requests", post({ reason }));
export const handOver = (request_id: number): Promise<unknown> =>
  request("lease/hand-over", post({ request_id }));
export const dropRequest = (id: number): Promise<unknown> =>
  request(`lease/requests/${id}`, { method: "DELETE" });
