import { describe, expect, it } from "vitest";
import { changesBetween, fieldOf, valueAt, withValue, written } from "./fields";
import type { Settings } from "./types";

const SETTINGS: Settings = {
  k_p: 1.19e-5,
  k_i: 4.38e-3,
  k_d: 3.39e-8,
  derivative_hz: 190,
  k_ff: 6e-9,
  valve_limit: 1,
  valve_slew_per_s: null,
  compensator: {
    ff_v: 1.9607,
    ff_a: 0.010862,
    lead_zero_hz: 1,
    lead_pole_hz: 3,
    low_pass_hz: 8,
    low_pass_order: 1,
    low_pass_damping: null,
    notch_damping: 0.15,
    fade_s: 0.1,
  },
};

describe("the settings' fields", () => {
  it("changes one value and leaves the rest", () => {
    const after = withValue(SETTINGS, "compensator.ff_v", -2);
    expect(valueAt(after, "compensator.ff_v")).toBe(-2);
    expect(changesBetween(SETTINGS, after)).toEqual([
      { path: "compensator.ff_v", label: "FF_V", before: "1.9607\u00a0s/m", after: "\u22122\u00a0s/m" },
    ]);
    expect(valueAt(SETTINGS, "compensator.ff_v")).toBe(1.9607);
  });

  it("keeps order and damping of the low-pass together", () => {
    const second = withValue(SETTINGS, "compensator.low_pass_order", 2);
    expect(valueAt(second, "compensator.low_pass_damping")).toBe(0.7);
    expect(changesBetween(second, withValue(second, "compensator.low_pass_order", 1)).map(({ label }) => label)).toEqual([
      "Low-pass order",
      "Low-pass damping",
    ]);
  });

  it("says nothing where nothing is, and knows no path by its own name only", () => {
    expect(written(null, "1/s")).toBe("—");
    expect(fieldOf("k_p").unit).toBe("1/N");
    expect(fieldOf("other").label).toBe("other");
  });
});
