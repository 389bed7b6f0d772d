import { expect, it } from "vitest";
import { si, written } from "./figures";

it.each([
  [0, "0"],
  [120730000, "1.2073·10⁸"],
  [0.00085, "8.5·10⁻⁴"],
  [-7.92e-6, "−7.92·10⁻⁶"],
  [0.67574, "0.67574"],
  [58.6004, "58.6"],
])("%s is written %s", (value, text) => expect(si(value)).toBe(text));

it("writes values of the configuration with their unit, and a dash where there is none", () => {
  expect(written(150_000_000, "N/m")).toBe("1.5·10⁸\u00a0N/m");
  expect(written(0.00085, "m")).toBe("8.5·10⁻⁴\u00a0m");
  expect([written("A-1", ""), written("", ""), written(null, "N")]).toEqual(["A-1", "—", "—"]);
});
