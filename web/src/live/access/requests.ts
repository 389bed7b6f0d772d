// Requests to /api/v1/auth.

import { post, request } from "../api";
import type { Me } from "./types";

export const getMe = (): Promise<Me> => request("auth/me");
export const signIn = (name: string, password: string): Promise<void> =>
  request("auth/login", post({ name, password }));
export const signOut = (): Promise<void> => request("auth/logout", post({}));
export const setPassword = (old: string | null, password: string): Promise<void> =>
  request("auth/password", post({ old, new: password }));
