// Requests of the System page.

import { post, request } from "../api";
import type { Role } from "../access/roles";
import type {
  About,
  AuditPage,
  Diagnosis,
  LoopTiming,
  MadeToken,
  Scope,
  SignedIn,
  SignInLink,
  Token,
  User,
  UserChange,
  Verification,
} from "./types";

const patch = (body: unknown): RequestInit => ({ ...post(body), method: "PATCH" });
const DELETE: RequestInit = { method: "DELETE" };

export const listUsers = (): Promise<User[]> => request("users");
export const addUser = (name: string, role: Role): Promise<User> => request("users", post({ name, role }));
export const changeUser = (id: number, change: UserChange): Promise<User> => request(`users/${id}`, patch(change));
export const removeUser = (id: number): Promise<void> => request(`users/${id}`, DELETE);
export const linkUser = (id: number): Promise<SignInLink> => request(`users/${id}/link`, post({}));

export const listTokens = (): Promise<Token[]> => request("tokens");
export const makeToken = (name: string, scope: Scope, expires_in_days: number | null): Promise<MadeToken> =>
  request("tokens", post({ name, scope, expires_in_days }));
export const revokeToken = (id: number): Promise<void> => request(`tokens/${id}`, DELETE);

export const listSessions = (): Promise<SignedIn[]> => request("sessions");
export const endSession = (id: number): Promise<void> => request(`sessions/${id}`, DELETE);

const VERIFYING_MS = 120_000;

export const listAudit = (query: string, before: number | null): Promise<AuditPage> => {
  const asked = new URLSearchParams(query);
  if (before !== null) asked.set("before", String(before));
  return request(`audit?${asked}`);
};
/** Walks the whole chain: it may take a while. */
export const verifyAudit = (): Promise<Verification> =>
  request("audit/verification", { signal: AbortSignal.timeout(VERIFYING_MS) });

export const getLoopTiming = (): Promise<LoopTiming> => request("system/loop");
export const getDiagnosis = (): Promise<Diagnosis> => request("system/doctor");
export const getAbout = (): Promise<About> => request("system/about");
