import { describe, expect, it } from "vitest";
import { answered, ASKED, askAgainAfter_s, gateOf, isReason, NONE, OPEN } from "./predicting";
import type { Prediction, Verdict } from "./types";

const reason = (severity: "caution" | "refused", text: string): Prediction["reasons"][number] => ({
  code: "near",
  text,
  severity,
  block: 0,
  time_s: 1,
});
const prediction = (verdict: Verdict, reasons: Prediction["reasons"] = []): Prediction =>
  ({ verdict, reasons }) as unknown as Prediction;

describe("a prediction", () => {
  it("comes closer and never runs backwards", () => {
    const near = answered(ASKED, { state: "computing", share: 0.6, seconds_left: 2 });
    expect(near).toEqual({ is: "computing", share: 0.6, left_s: 2 });
    expect(answered(near, { state: "computing", share: 0.4, seconds_left: 3 })).toMatchObject({ share: 0.6 });
    expect(answered(near, prediction("clear"))).toMatchObject({ is: "done" });
  });

  it("is asked for again soon where little is left, and never more than four times a second", () => {
    expect(askAgainAfter_s(ASKED)).toBe(0.5);
    expect(askAgainAfter_s({ is: "computing", share: 0.9, left_s: 0.1 })).toBe(0.25);
    expect(askAgainAfter_s({ is: "computing", share: 0.1, left_s: 600 })).toBe(2);
  });
});

describe("Start", () => {
  it("waits for the prediction", () => {
    expect(gateOf(ASKED)).toMatchObject({ is: "closed" });
    expect(gateOf(NONE)).toBe(OPEN);
  });

  it("is open where all is clear, wants a reason for a caution, and is closed by a refusal", () => {
    expect(gateOf({ is: "done", prediction: prediction("clear") })).toBe(OPEN);
    expect(gateOf({ is: "done", prediction: prediction("caution", [reason("caution", "Close")]) })).toEqual({
      is: "reason",
      why: "Close",
    });
    const both = [reason("caution", "Close"), reason("refused", "Force limit passed at 2 s")];
    expect(gateOf({ is: "done", prediction: prediction("refused", both) })).toEqual({
      is: "closed",
      why: "Force limit passed at 2 s",
    });
  });

  it("is left to the server where the prediction could not be had", () => {
    expect(gateOf({ is: "failed", why: "No answer", final: false })).toBe(OPEN);
    expect(gateOf({ is: "failed", why: "Block 2 is beyond the rig", final: true })).toMatchObject({
      is: "closed",
    });
  });

  it("does not take a blank for a reason", () => {
    expect(isReason("  x ")).toBe(false);
    expect(isReason("Agreed with the customer")).toBe(true);
  });
});
