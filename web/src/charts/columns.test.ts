import { describe, expect, it } from "vitest";
import { eachBar, type Bar } from "./columns";

const same = (value: number): number => value;

function bars(y: (number | null)[], thickness = 0): Bar[] {
  const x = y.map((_, i) => Math.floor(i / 2) + (i % 2 ? 0.75 : 0.25));
  const result: Bar[] = [];
  eachBar(x, y, same, same, thickness, (bar) => result.push({ ...bar }));
  return result;
}

describe("eachBar", () => {
  it("spans both extremes of its column", () => {
    expect(bars([2, 9])).toEqual([{ x: 0, width: 1, y: 2, height: 7 }]);
    expect(bars([9, 2])).toEqual([{ x: 0, width: 1, y: 2, height: 7 }]);
  });

  it("reaches back to where the column before ended, so that a line has no breaks", () => {
    expect(bars([0, 1, 5, 6])[1]).toEqual({ x: 1, width: 1, y: 1, height: 5 });
    expect(bars([6, 5, 1, 0])[1]).toEqual({ x: 1, width: 1, y: 0, height: 5 });
  });

  it("has the thickness of a line where the signal stands still", () => {
    expect(bars([3, 3, 3, 3], 2)).toEqual([
      { x: 0, width: 1, y: 2, height: 2 },
      { x: 1, width: 1, y: 2, height: 2 },
    ]);
  });

  it("leaves a gap for a column without samples and does not bridge it", () => {
    expect(bars([0, 0, null, null, 8, 8], 1)).toEqual([
      { x: 0, width: 1, y: -0.5, height: 1 },
      { x: 2, width: 1, y: 7.5, height: 1 },
    ]);
  });

  it("leaves no white stripe between columns that are not a whole pixel wide", () => {
    const x: number[] = [];
    for (let i = 0; i < 300; i += 1) x.push(i * 1.37 + 0.25 * 1.37, i * 1.37 + 0.75 * 1.37);
    let end: number | null = null;
    eachBar(
      x,
      x.map(() => 1),
      same,
      same,
      1,
      (bar) => {
        if (end !== null) expect(bar.x).toBe(end);
        end = bar.x + bar.width;
      },
    );
    expect(end).toBe(411);
  });
});
