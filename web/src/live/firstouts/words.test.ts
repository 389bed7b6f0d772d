import { describe, expect, it } from "vitest";
import { afterFirst, chartsFor, inOrderOfTripping, limitsByChart, timeText } from "./words";

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
      { name: "force", quantity: "force_n", comparison: "magnitude_above", threshold: 55e3 },
      { name: "ahead", quantity: "force_n", form: "look_ahead", comparison: "above", threshold: 1 },
      { name: "off", quantity: "force_n", comparison: "above", threshold: 2, enabled: false },
      { name: "band", quantity: "displacement_m", comparison: "outside", threshold: 0.03, low: -0.02 },
      { name: "cell", quantity: "load_cell", comparison: "above", threshold: 0.5 },
    ]);
    expect(limits).toEqual({ force: [-55e3, 55e3], displacement: [0.03, -0.02] });
  });

  it("shows the chart of what tripped first", () => {
    expect(chartsFor({ quantity: "supply_pressure_pa" })).toEqual(["pressures", "force", "displacement"]);
    expect(chartsFor({ quantity: "lvt" })).toEqual(["force", "displacement", "valve"]);
  });
});
