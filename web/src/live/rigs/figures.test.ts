import { expect, it } from "vitest";
import { si } from "./figures";

it.each([
  [0, "0"],
  [120730000, "1.2073·10⁸"],
  [0.00085, "8.5·10⁻⁴"],
  [-7.92e-6, "−7.92·10⁻⁶"],
  [0.67574, "0.67574"],
  [58.6004, "58.6"],
])("%s is written %s", (value, text) => expect(si(value)).toBe(text));
