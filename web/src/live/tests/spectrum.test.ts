import { describe, expect, it } from "vitest";
import { pasteOf, totals, withFigures } from "./spectrum";

const layer = (mean_n: number, cycles: number): Parameters<typeof withFigures>[0][number] => ({
  ...{ mean_n, cycles },
  ...{ amplitude_n: 2000, frequency_hz: 10 },
});

describe("a paste", () => {
  it("is figures, a table with a header, or one cell", () => {
    expect(pasteOf("12,5").kind).toBe("cell");
    expect(pasteOf("abc").kind).toBe("cell");
    expect(pasteOf("1\t2\r\n3\t4,5\r\n")).toEqual({ kind: "figures", cells: [["1", "2"], ["3", "4,5"]] });
    expect(pasteOf("mean [kN];amplitude [kN]\n1;2").kind).toBe("table");
    expect(pasteOf("1\n2\n3")).toEqual({ kind: "figures", cells: [["1"], ["2"], ["3"]] });
    expect(pasteOf("mean_n,amplitude_n,frequency_hz,cycles").kind).toBe("table");
  });

  it("goes over the cells from the cursor on, in kN, and adds rows", () => {
    const out = withFigures([layer(0, 10), layer(1000, 20)], 1, 1, [["2,5", "20"], ["3", "\u22125", "7"]]);
    expect(out).toHaveLength(3);
    expect(out[0]).toEqual(layer(0, 10));
    expect(out[1]).toEqual({ mean_n: 1000, amplitude_n: 2500, frequency_hz: 20, cycles: 20 });
    expect(out[2]).toEqual({ mean_n: 1000, amplitude_n: 3000, frequency_hz: -5, cycles: 7 });
  });

  it("leaves out what does not fit the table, and cells that are empty", () => {
    expect(withFigures([layer(5, 10)], 0, 3, [["", "9", "9"]])).toEqual([layer(5, 10)]);
    expect(withFigures([layer(5, 10)], 0, 3, [["12", "9", "9"]])).toEqual([layer(5, 12)]);
  });
});

describe("totals", () => {
  it("add up cycles and time, times the passes", () => {
    expect(totals([layer(0, 10), layer(0, 30)], 3)).toEqual({ cycles: 120, duration_s: 12 });
    expect(totals([{ cycles: 5 }], 1)).toEqual({ cycles: 5, duration_s: 0 });
  });
});
