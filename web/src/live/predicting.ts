// The prediction of the chosen test, from asking to the answer, and what it means for Start. Pure.

import type { Computing, Prediction } from "./types";

export type Predicting =
  | { readonly is: "none" }
  | { readonly is: "computing"; readonly share: number | null; readonly left_s: number | null }
  | { readonly is: "done"; readonly prediction: Prediction }
  | { readonly is: "failed"; readonly why: string; readonly final: boolean };

export type StartGate =
  | { readonly is: "open" }
  /** Start is possible with a reason that a person gives. */
  | { readonly is: "reason"; readonly why: string }
  | { readonly is: "closed"; readonly why: string };

export const NONE: Predicting = { is: "none" };
export const ASKED: Predicting = { is: "computing", share: null, left_s: null };
export const OPEN: StartGate = { is: "open" };

/** What an answer of the server makes of it; a share that was there never runs backwards. */
export function answered(before: Predicting, answer: Prediction | Computing): Predicting {
  if (!("state" in answer)) return { is: "done", prediction: answer };
  const least = before.is === "computing" ? (before.share ?? 0) : 0;
  const share = Math.min(1, Math.max(least, answer.share));
  return { is: "computing", share, left_s: answer.seconds_left };
}

/** How long to wait before asking again, s: often where little is left, seldom where much is. */
export function askAgainAfter_s(state: Predicting): number {
  const left = state.is === "computing" ? state.left_s : null;
  return left === null ? 0.5 : Math.min(2, Math.max(0.25, left / 4));
}

/** What the prediction means for Start. A server that cannot be asked decides at the start itself. */
export function gateOf(state: Predicting): StartGate {
  if (state.is === "computing") return { is: "closed", why: "The prediction is being computed" };
  if (state.is === "failed") return state.final ? { is: "closed", why: state.why } : OPEN;
  if (state.is === "none") return OPEN;
  const { verdict, reasons } = state.prediction;
  const first = reasons.find(({ severity }) => severity === verdict)?.text ?? reasons[0]?.text;
  if (verdict === "refused") return { is: "closed", why: first ?? "The prediction refuses this test" };
  if (verdict === "caution") return { is: "reason", why: first ?? "The prediction warns" };
  return OPEN;
}

export const REASON_LEAST = 3;

/** Whether a reason for an override says anything. */
export const isReason = (text: string): boolean => text.trim().length >= REASON_LEAST;
