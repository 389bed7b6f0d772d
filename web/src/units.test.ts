import { describe, expect, it } from "vitest";
import {
  axisFigures,
  count,
  duration,
  figure,
  figureWidth,
  FORCE,
  fromEntry,
  gainQuantity,
  LENGTH,
  localTime,
  microseconds,
  PLAIN,
  PRESSURE,
  quantityOf,
  RATIO,
  SPEED,
  toEntry,
  withUnit,
} from "./units";

describe("figures", () => {
  it("turn SI into what the control room reads", () => {
    expect(withUnit(FORCE, 1987.2)).toBe("1.99\u00a0kN");
    expect(withUnit(LENGTH, -0.0123456)).toBe("\u221212.35\u00a0mm");
    expect(withUnit(PRESSURE, 21e6)).toBe("210.0\u00a0bar");
    expect(withUnit(RATIO, 0.183)).toBe("18.3\u00a0%");
    expect(withUnit(SPEED, 0.25)).toBe("250.0\u00a0mm/s");
  });

  it("keep their digits, so that nothing jumps", () => {
    const lengths = [0, 1, 999.999, 1000, 9994].map((force_n) => figure(FORCE, force_n).length);
    expect(new Set(lengths)).toEqual(new Set([4]));
    expect(figureWidth(FORCE, 55000)).toBe("−55.00".length);
  });

  it("show no minus before zero and a true minus elsewhere", () => {
    expect(figure(FORCE, -4)).toBe("0.00");
    expect(figure(FORCE, -0)).toBe("0.00");
    expect(figure(FORCE, -5.1)).toBe("\u22120.01");
  });

  it("show a dash for what is not known", () => {
    for (const unknown of [NaN, Infinity, -Infinity, null, undefined])
      expect(figure(FORCE, unknown)).toBe("—");
    expect(withUnit(FORCE, NaN)).toBe("—\u00a0kN");
    expect(duration(NaN)).toBe("—");
    expect(count(null)).toBe("—");
  });
});

describe("quantityOf", () => {
  it("reads the unit off the end of the channel name", () => {
    expect(quantityOf("force_error_n")).toBe(FORCE);
    expect(quantityOf("displacement_command_m")).toBe(LENGTH);
    expect(quantityOf("velocity_m_s")).toBe(SPEED);
    expect(quantityOf("supply_pressure_pa")).toBe(PRESSURE);
    expect(quantityOf("spool_position")).toBe(RATIO);
  });
});

describe("gainQuantity", () => {
  it("knows each unit that the backend gives a transfer", () => {
    const shown = (unit: string): string => withUnit(gainQuantity(unit), 1e-6, -2);
    expect(gainQuantity("1").symbol).toBe("");
    expect(["N", "m/s", "N s/m"].map((unit) => gainQuantity(unit).symbol)).toEqual(["kN", "mm/s", "kN s/m"]);
    expect([shown("m/N"), shown("m/(N s)")]).toEqual(["1.0\u00a0mm/kN", "1.0\u00a0mm/(kN s)"]);
    expect(withUnit(gainQuantity("N/m"), 2e7)).toBe("20.000\u00a0kN/mm");
  });
});

describe("axisFigures", () => {
  it("shows just enough digits to tell marks apart", () => {
    expect(axisFigures(FORCE, [-2000, -1000, 0, 1000], 1000)).toEqual(["−2", "−1", "0", "1"]);
    expect(axisFigures(FORCE, [0, 250, 500], 250)).toEqual(["0.00", "0.25", "0.50"]);
    expect(axisFigures(LENGTH, [0, 0.0005], 0.0005)).toEqual(["0.0", "0.5"]);
  });
});

describe("counts and times", () => {
  it("group thousands", () => {
    expect(count(81234)).toBe("81\u202f234");
    expect(count(999)).toBe("999");
    expect(count(1234567)).toBe("1\u202f234\u202f567");
  });

  it("read spans aloud", () => {
    expect(duration(4.4)).toBe("4.4\u00a0s");
    expect(duration(59.97)).toBe("1:00\u00a0min");
    expect(duration(125)).toBe("2:05\u00a0min");
    expect(duration(3725)).toBe("1:02:05\u00a0h");
    expect(duration(-0.01)).toBe("0.0\u00a0s");
    expect(microseconds(9e-6)).toBe("9\u00a0µs");
  });

  it("shows a moment on the clock of the reader", () => {
    expect(localTime("2024-11-22T06:03:09Z", "Europe/Rome")).toBe("2024-11-22 07:03:09");
    expect(localTime("not a time")).toBe("—");
  });
});

describe("fields", () => {
  it("show as many digits as a value has, and read back what they show", () => {
    expect(toEntry(FORCE, 1234.5)).toBe("1.2345");
    expect(toEntry(FORCE, -2000)).toBe("\u22122");
    for (const si of [0, 1, -0.1, 2000, 1100, 49_999.9, 1e-3]) expect(fromEntry(FORCE, toEntry(FORCE, si))).toBe(si);
  });

  it("take a decimal comma, spaces between thousands and a true minus, and refuse what is no figure", () => {
    expect(fromEntry(FORCE, " 1,5 ")).toBe(1500);
    expect(fromEntry(FORCE, "\u22122.5")).toBe(-2500);
    expect(fromEntry(PLAIN, "1 000 000")).toBe(1e6);
    expect(fromEntry(PLAIN, "1e6")).toBe(1e6);
    for (const text of ["", "-", "abc", "1,2,3", "0x10", "1 kN"]) expect(fromEntry(FORCE, text), text).toBeNull();
  });
});
