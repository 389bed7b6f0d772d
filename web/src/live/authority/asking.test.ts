import { describe, expect, it } from "vitest";
import type { Lease } from "../types";
import { followRequest, left_s } from "./asking";

const lease = (...ids: number[]): Lease =>
  ({ holder: "Ann", requests: ids.map((id) => ({ id, name: "Bo", reason: "", since: "" })) }) as unknown as Lease;

describe("followRequest", () => {
  it("stands until a status that has seen it shows it no more", () => {
    const made = { id: 3, seen: false };
    expect(followRequest(made, lease(1))).toEqual({ asking: made });
    const seen = followRequest(made, lease(1, 3)).asking;
    expect(seen).toEqual({ id: 3, seen: true });
    expect(followRequest(seen, lease(3)).asking).toBe(seen);
    expect(followRequest(seen, lease(1))).toEqual({ asking: null, word: "Ann keeps control for now." });
  });

  it("needs no answer once nobody is in command", () => {
    expect(followRequest({ id: 3, seen: true }, null).word).toContain("Take command with C");
    expect(followRequest(null, null)).toEqual({ asking: null });
  });
});

describe("left_s", () => {
  const at = Date.UTC(2024, 10, 22, 14);
  const since = new Date(at).toISOString();

  it("counts down from when it was asked", () => {
    expect(left_s(since, at, at)).toBe(60);
    expect(left_s(since, at + 5000, at + 20_500)).toBe(40);
    expect(left_s(since, at, at + 90_000)).toBe(0);
  });

  it("does with the time it was first seen where the clocks differ", () => {
    expect(left_s(since, at - 3_600_000, at - 3_590_000)).toBe(50);
    expect(left_s("", at, at + 10_000)).toBe(50);
  });
});
