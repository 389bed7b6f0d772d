import { describe, expect, it } from "vitest";
import { inUnit, quantityOfUnit, spoken } from "./quantities";

const plain = (text: string): string => text.replace(/\u00a0/g, " ");

describe("quantities by unit", () => {
  it("reads units as people at a rig do", () => {
    expect(plain(inUnit(-32_500, "N"))).toBe("−32.50 kN");
    expect(plain(inUnit(21e6, "Pa"))).toBe("210.0 bar");
    expect(plain(inUnit(1e-3, "m³/s"))).toBe("60.0 l/min");
    expect(plain(inUnit(0.015, "1", "valve_saturation_share"))).toBe("1.50 %");
    expect(plain(inUnit(Math.PI, "rad"))).toBe("180.0 °");
    expect(plain(inUnit(null, "N"))).toBe("— kN");
  });

  it("shows a unit that it does not know as it is", () => {
    expect(quantityOfUnit("V").symbol).toBe("V");
    expect(quantityOfUnit("1", "crest_factor").symbol).toBe("");
  });

  it("keeps digits that say something of what is small", () => {
    expect(plain(inUnit(48, "N"))).toBe("0.0480 kN");
    expect(plain(inUnit(1.234, "N"))).toBe("0.0012 kN");
    expect(inUnit(200, "1", "cycles")).toBe("200");
    expect(plain(inUnit(0, "N"))).toBe("0.00 kN");
  });

  it("says names aloud", () => {
    expect(spoken("force_error_rms_n")).toBe("Force error RMS");
    expect(spoken("valve_saturation_share")).toBe("Valve saturation share");
    expect(spoken("velocity_m_s")).toBe("Velocity");
    expect(spoken("supply_flow_m3_s")).toBe("Supply flow");
  });
});
