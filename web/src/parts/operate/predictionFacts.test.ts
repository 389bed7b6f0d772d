import { describe, expect, it } from "vitest";
import type { Prediction } from "../../live/types";
import { computed, predictionFacts } from "./predictionFacts";

const WHOLE = {
  ...{ duration_s: 120, predicted_s: 120.5, outcome: "completed", shortened: [] },
  ...{ peaks: {}, valve: { peak: 0, saturation_share: 0, longest_saturation_s: 0 } },
} as unknown as Prediction;
const EARLY = { ...WHOLE, predicted_s: 15.7 };
const SHORTENED = { ...EARLY, shortened: [{ path: "blocks[0]", text: "10 of 100 repeats" }] };
const TRIPPED = { ...EARLY, outcome: "tripped" };

const lasts = (prediction: Prediction): string | undefined => predictionFacts(prediction)[0]?.text;

describe("how long a test lasts", () => {
  it("is its duration, and nothing more is to be said", () => {
    expect([lasts(WHOLE), computed(WHOLE)]).toEqual(["2:00\u00a0min", ""]);
  });
  it("is what was predicted where the test itself ends early", () => {
    expect(lasts(EARLY)).toBe("about 15.7\u00a0s");
    expect(computed(EARLY)).toContain("after 2:00\u00a0min at the latest");
  });
  it("is its duration where less was computed, or it came to an end before its own", () => {
    for (const prediction of [SHORTENED, TRIPPED] as Prediction[]) {
      expect(lasts(prediction)).toBe("2:00\u00a0min");
      expect(computed(prediction)).toBe("Computed: 15.7\u00a0s of 2:00\u00a0min.");
    }
  });
});
