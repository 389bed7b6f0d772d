import { expect, it } from "vitest";
import { Misses } from "./misses";

it("colours misses for a minute after they happened, not for ever", () => {
  const misses = new Misses();
  expect(misses.lately(115, 0)).toBe(false);
  expect(misses.lately(115, 1)).toBe(false);
  expect(misses.lately(116, 2)).toBe(true);
  expect(misses.lately(116, 61)).toBe(true);
  expect(misses.lately(116, 63)).toBe(false);
  expect(misses.lately(0, 64)).toBe(false); // another loop
});
