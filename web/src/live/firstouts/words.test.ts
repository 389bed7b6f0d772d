import { describe, expect, it } from "vitest";
import { aDetector } from "../interlocks/aDetector";
import type { TripKept } from "./types";
import { afterFirst, chartsFor, compared, inOrderOfTripping, limitsByChart, timeText } from "./words";

const plain = (text: string): string => text.replaceAll("\u00a0", " ");

describe("a first-out in words", () => {
  it("tells what tripped in its order, the first-out on top even of its own tick", () => {
    const trips = [
      { code: "b", tick: 12, first: false },
      { code: "a", tick: 10, first: false },
      { code: "c", tick: 10, first: true },
    ];
    expect(inOrderOfTripping(trips).map(({ code }) => code)).toEqual(["c", "a", "b"]);
  });

  it("says how long after it the others came", () => {
    expect(afterFirst(10, 10, 1 / 4000)).toBe("same tick");
    expect(plain(afterFirst(10, 13, 1 / 4000))).toBe("+3 ticks, 0.75 ms");
    expect(plain(afterFirst(10, 9, 1 / 4000))).toBe("−1 tick, 0.25 ms");
    expect(plain(afterFirst(0, 6000, 1 / 4000))).toBe("+1.50 s");
    expect(plain(afterFirst(0, 3, null))).toBe("+3 ticks");
  });

  it("counts times from it", () => {
    expect([0, -0.01225, 1.2, null].map((time_s) => plain(timeText(time_s)))).toEqual([
      "0",
      "−12.25 ms",
      "+1.200 s",
      "—",
    ]);
  });

  it("draws the limits where their quantities are drawn, as they are", () => {
    const limits = limitsByChart([
      aDetector({ quantity: "force_n", threshold: 55e3 }),
      aDetector({ quantity: "force_n", form: "look_ahead", comparison: "above", threshold: 1 }),
      aDetector({ quantity: "force_n", comparison: "above", threshold: 2, enabled: false }),
      aDetector({ quantity: "displacement_m", comparison: "outside", threshold: 0.03, low: -0.02 }),
      aDetector({ quantity: "load_cell", comparison: "above", threshold: 0.5 }),
    ]);
    expect(limits).toEqual({ force: [-55e3, 55e3], displacement: [0.03, -0.02] });
  });

  it("shows the chart of what tripped first", () => {
    expect(chartsFor({ quantity: "supply_pressure_pa" })).toEqual(["pressures", "force", "displacement"]);
    expect(chartsFor({ quantity: "lvt" })).toEqual(["force", "displacement", "valve"]);
  });

  it("sets what would have tripped beside what did, the earliest on top", () => {
    const trip = (detector: string, time_s: number): TripKept => ({ detector, time_s }) as TripKept;
    const rows = compared([trip("a", 0), trip("b", 0.5)], [trip("a", 0.2), trip("c", -0.1)]);
    expect(rows.map(({ detector, recorded, changed }) => [detector, recorded?.time_s, changed?.time_s])).toEqual([
      ["c", undefined, -0.1],
      ["a", 0, 0.2],
      ["b", 0.5, undefined],
    ]);
  });
});
