import { describe, expect, it } from "vitest";
import { aDetector, aReading } from "./aDetector";
import type { Detector } from "./types";
import { stateText } from "./states";
import { ALL_MODES, armedText, limitText, persistenceText, valueText, watches } from "./words";

const plain = (text: string): string => text.replaceAll("\u00a0", " ");

describe("a detector in words", () => {
  it("names its limit in the units of the control room", () => {
    expect(plain(limitText(aDetector()))).toBe("± 55.00 kN");
    expect(plain(limitText(aDetector({ quantity: "supply_pressure_pa", comparison: "below", threshold: 15e6 })))).toBe(
      "at least 150.0 bar",
    );
    const band = aDetector({ quantity: "displacement_m", comparison: "outside", threshold: 5e-3, low: -5e-3 });
    expect(plain(limitText(band))).toBe("−5.00 … 5.00 mm");
    expect(plain(limitText(aDetector({ form: "rate", comparison: "above", threshold: 2e6 })))).toBe("at most 2000 kN/s");
    expect(limitText(aDetector({ quantity: "load_cell", comparison: "above", threshold: 0.5 }))).toBe("sound");
  });

  it("says what it sees: a figure, a state, or that it is none", () => {
    expect(plain(valueText(aDetector(), -1234))).toBe("−1.23 kN");
    expect(valueText(aDetector({ quantity: "load_cell" }), 3)).toBe("frozen");
    expect(valueText(aDetector({ quantity: "chain_open" }), 0)).toBe("closed");
    expect(valueText(aDetector(), null)).toBe("—");
    expect(valueText(aDetector(), NaN)).toBe("—");
  });

  it("says what it watches, and how", () => {
    expect(watches(aDetector())).toBe("Force");
    expect(watches(aDetector({ form: "rate", quantity: "lvt" }))).toBe("Rate of LVT");
    expect(plain(watches(aDetector({ form: "look_ahead", horizon_s: 0.02, quantity: "displacement_m" })))).toBe(
      "Displacement in 20 ms",
    );
  });

  it("has words even for what only a newer server watches", () => {
    const newer = aDetector({ quantity: "oil_level_m" as Detector["quantity"], threshold: 0.1 });
    expect(watches(newer)).toBe("Oil level");
    expect(plain(valueText(newer, 0.05))).toBe("50.00 mm");
  });

  it("says when it acts and is armed", () => {
    expect(persistenceText(0)).toBe("at once");
    expect(plain(persistenceText(0.05))).toBe("50 ms");
    expect(plain(persistenceText(15))).toBe("15.0 s");
    expect(armedText(ALL_MODES)).toBe("always");
    expect(armedText(["holding", "running"])).toBe("in a test");
    expect(armedText(["ready", "off"])).toBe("off, ready");
    expect(armedText([])).toBe("never");
  });

  it("counts aloud", () => {
    const counting = aReading({ state: "counting", violated_s: 0.032 });
    expect(plain(stateText(aDetector({ persistence_s: 0.05 }), counting))).toBe("Counting 32 of 50 ms");
    expect(plain(stateText(aDetector({ persistence_s: 15 }), { ...counting, violated_s: 3.21 }))).toBe("Counting 3.2 of 15.0 s");
    expect(stateText(aDetector(), null)).toBe("Not known");
  });
});
