import { describe, expect, it } from "vitest";
import { fromEntry } from "../../units";
import { MEASUREMENT_NAMES, quantityOfMeasurement } from "./measurements";

describe("limits of measurements", () => {
  it("are written in kN, mm and per cent", () => {
    expect(fromEntry(quantityOfMeasurement("force_error_rms_n"), "0.3")).toBe(300);
    expect(fromEntry(quantityOfMeasurement("peak_displacement_m"), "2")).toBe(0.002);
    expect(fromEntry(quantityOfMeasurement("valve_saturation_share"), "1")).toBe(0.01);
    expect(fromEntry(quantityOfMeasurement("goodness_of_fit"), "85")).toBe(85);
    expect(fromEntry(quantityOfMeasurement("step_overshoot_percent"), "30")).toBe(30);
    expect(fromEntry(quantityOfMeasurement("unknown"), "5")).toBe(5);
  });

  it("have a unit for every measurement of the backend", () => {
    for (const name of MEASUREMENT_NAMES.filter((known) => /_(n|m|s|deg|percent|share)$/.test(known)))
      expect(quantityOfMeasurement(name).symbol, name).not.toBe("");
  });
});
