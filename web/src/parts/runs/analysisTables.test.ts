import { describe, expect, it } from "vitest";
import type { Analysis } from "../../live/responses/types";
import { budgetTable, damageTable, layerTable, rangeClasses, stepTable } from "./analysisTables";

const SPREAD = { count: 9, mean: 2100, deviation: 12, low: 2080, high: 2120 };
const ANALYSIS = {
  unit: [],
  steps: [
    {
      ...{ block: 1, time_s: 2.5, begin_n: 0, end_n: 2000, dead_time_s: 0.002, rise_s: 0.0081 },
      ...{ overshoot_percent: 3.2, settling_s: null, steady_error_n: -4 },
    },
  ],
  layers: [
    {
      ...{ block: 0, asked: { frequency_hz: 50, amplitude_n: 2000, mean_n: 0 }, cycles: 100, amplitude_n: 2050 },
      ...{ mean_n: 3, phase_deg: -20, amplitude_error_percent: 2.5, mean_error_n: 3, distortion_percent: 0.4 },
      ...{ peak_n: SPREAD, valley_n: { ...SPREAD, deviation: null }, cycle_mean_n: SPREAD, range_n: SPREAD, harmonics: [] },
    },
  ],
  rainflow: {
    ...{ gate_n: 10, class_n: 500, asked_cycles: 100, applied_cycles: 99.5 },
    ...{ asked_largest_range_n: 4000, applied_largest_range_n: 4100, matrix: [] },
    spectrum: [
      { from_n: 0, to_n: 500, asked: 0, applied: 0 },
      { from_n: 500, to_n: 1000, asked: 0, applied: 9 },
      { from_n: 4000, to_n: 4500, asked: 99, applied: 99 },
    ],
  },
  damage: [{ exponent: 5, cycles: 1e6, asked_amplitude_n: 2000, applied_amplitude_n: 2040, ratio: 1.104 }],
  uncertainty: {
    contributions: [
      { name: "Noise", value_n: 2, shape: "normal", standard_n: 2, source: "run", how: "at rest", of_unit: false },
      { name: "Class", value_n: 25, shape: "rectangular", standard_n: 14.4, source: "rig", how: "0.05 %", of_unit: false },
    ],
  },
} as unknown as Analysis;

describe("an analysis as tables", () => {
  it("has a row a step, with a dash where the response did not get that far", () => {
    const { columns, rows } = stepTable(ANALYSIS);
    expect(rows[0]!.cells).toHaveLength(columns.length);
    expect(rows[0]!.cells.slice(2, 6)).toEqual(["2.00", "8.10", "3.20", "—"]);
  });
  it("says what a layer asked for and how far it was off", () => {
    const [row] = layerTable(ANALYSIS).rows;
    expect(row!.head).toBe("Block 1, 2.00\u00a0kN at 50\u00a0Hz");
    expect(row!.cells[2]).toBe("2.50");
    expect(row!.cells[6]).toMatch(/^2.10 ± /);
    expect(row!.cells[7]).toBe("2.10");
  });
  it("names the mean where there is one, and no block where all is of one", () => {
    const [layer] = ANALYSIS.layers;
    const about = { ...layer!, asked: { ...layer!.asked!, mean_n: 5000 } };
    const rows = layerTable({ ...ANALYSIS, steps: [], layers: [layer!, about] }).rows;
    expect(rows.map(({ head }) => head)).toEqual([
      "2.00\u00a0kN at 50\u00a0Hz",
      "2.00\u00a0kN about 5.00\u00a0kN at 50\u00a0Hz",
    ]);
  });
  it("has the greatest contribution first", () => {
    expect(budgetTable(ANALYSIS).rows.map(({ head }) => head)).toEqual(["Class", "Noise"]);
  });
  it("leaves out classes without a cycle, and has the greatest range first", () => {
    const classes = rangeClasses(ANALYSIS);
    expect(classes.map(({ asked }) => asked)).toEqual([99, 0]);
    expect(classes[0]!.askedShare).toBe(1);
    expect(classes[1]!.appliedShare).toBeCloseTo(0.5, 9);
  });
  it("compares damage as a ratio, and amplitudes to the same digit", () => {
    expect(damageTable(ANALYSIS).rows[0]!.cells).toEqual(["2.000", "2.040", "1.104"]);
  });
});
