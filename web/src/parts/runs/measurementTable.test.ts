import { describe, expect, it } from "vitest";
import type { RunMeasurements } from "../../live/types";
import { measurementTable } from "./measurementTable";

const RESULTS: RunMeasurements = {
  verdict: "fail",
  criteria: [
    { measurement: "peak_force_n", block: 1, unit: "N", value: 3e4, at_least: null, at_most: 2e4, outcome: "fail" },
    { measurement: "peak_force_n", block: null, unit: "N", value: 3e4, at_least: null, at_most: 4e4, outcome: "pass" },
  ],
  run: [{ name: "peak_force_n", unit: "N", value: 3e4 }],
  blocks: [
    { block: 0, kind: "hold", measurements: [{ name: "peak_force_n", unit: "N", value: 5 }] },
    {
      block: 1,
      kind: "time_history",
      measurements: [
        { name: "peak_force_n", unit: "N", value: 3e4 },
        { name: "thd_share", unit: "1", value: null },
      ],
    },
  ],
};

describe("measurementTable", () => {
  it("has the whole run on top, a row a block and a column a measurement", () => {
    const { columns, rows } = measurementTable(RESULTS);
    expect(columns.map(({ title, symbol }) => [title, symbol])).toEqual([
      ["Peak force", "kN"],
      ["Thd share", "%"],
    ]);
    expect(rows.map(({ block, kind }) => [block, kind])).toEqual([
      [null, "Whole run"],
      [0, "hold"],
      [1, "time history"],
    ]);
    expect(rows.map(({ cells }) => cells.map(({ text }) => text))).toEqual([
      ["30.00", ""],
      ["0.0050", ""],
      ["30.00", "—"],
    ]);
  });

  it("marks what failed in the block that it was asked of, and nowhere else", () => {
    const { rows } = measurementTable(RESULTS);
    expect(rows.map(({ cells }) => cells[0]!.failed)).toEqual([false, false, true]);
  });
});
