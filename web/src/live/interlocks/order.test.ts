import { describe, expect, it } from "vitest";
import { aDetector, aReading } from "./aDetector";
import { arranged, ordered, rowsOf, type Row } from "./order";

const names = (rows: readonly Row[]): string[] => rows.map(({ detector }) => detector.name);

describe("the order of the table", () => {
  const detectors = ["a", "b", "c", "d", "e"].map((name) => aDetector({ name }));
  const rows = rowsOf(detectors, [
    aReading({ name: "a", margin_share: 0.9 }),
    aReading({ name: "b", margin_share: -0.1, state: "tripped" }),
    aReading({ name: "c", margin_share: 0.2 }),
    aReading({ name: "d", margin_share: 0.01, state: "not_armed" }),
  ]);

  it("puts what tripped first, then the least margin, what is not armed or not known last", () => {
    expect(names(ordered(rows, "table"))).toEqual(["a", "b", "c", "d", "e"]);
    expect(names(ordered(rows, "margin"))).toEqual(["b", "c", "a", "d", "e"]);
  });

  it("stays as it was settled while values move; what is new comes last", () => {
    expect(names(arranged(rows, ["c", "b", "a"]))).toEqual(["c", "b", "a", "d", "e"]);
  });
});
