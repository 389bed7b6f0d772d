import { describe, expect, it } from "vitest";
import type { Margin } from "../../live/types";
import { marginRows } from "./margins";

const margin = (detector: string, change: Partial<Margin> = {}): Margin => ({
  detector,
  quantity: "force_n",
  form: "value",
  unit: "N",
  threshold: 50e3,
  extreme: 33e3,
  margin: 17e3,
  margin_share: 0.34,
  time_s: 2.31,
  tick: 9240,
  block: 2,
  action: "stop",
  predicted: true,
  note: "",
  ...change,
});

describe("marginRows", () => {
  it("has the smallest margin on top and what cannot be predicted at the end", () => {
    const rows = marginRows([
      margin("emergency_stop", { predicted: false, margin_share: null, extreme: null, note: "Only the live rig can tell" }),
      margin("force_high"),
      margin("velocity_high", { margin_share: -0.2 }),
      margin("supply_low", { margin_share: null, extreme: null }),
    ]);
    expect(rows.map(({ name }) => name)).toEqual(["Velocity high", "Force high", "Supply low", "Emergency stop"]);
    expect(rows.map(({ nearness }) => nearness)).toEqual(["beyond", "within", "within", "within"]);
    expect(rows.at(-1)).toMatchObject({ extreme: "Only the live rig can tell", share: "—" });
    expect(rows.map(({ used }) => used)).toEqual([1, 0.6599999999999999, null, null]);
  });

  it("says extreme, limit, second and block", () => {
    const [row] = marginRows([margin("force_high", { margin_share: 0.05 })]);
    expect(row!.extreme.replace(/\u00a0/g, " ")).toBe("33.00 kN of 50.00 kN");
    expect(row!.when.replace(/\u00a0/g, " ")).toBe("at 2.3 s, block 3");
    expect(row).toMatchObject({ nearness: "near", share: "5\u00a0%" });
  });
});
