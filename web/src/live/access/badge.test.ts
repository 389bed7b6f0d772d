import { afterEach, expect, it } from "vitest";
import { badge, withBadge } from "./badge";

afterEach(() => (badge.csrf = ""));

it("shows the token of the session only where something may change", () => {
  badge.csrf = "abc";
  expect(withBadge(undefined, undefined).get("X-CSRF-Token")).toBeNull();
  for (const method of ["POST", "PUT", "PATCH", "DELETE"])
    expect(withBadge(method, undefined).get("X-CSRF-Token")).toBe("abc");
});

it("shows none before anybody is signed in, and keeps the request's own headers", () => {
  const headers = withBadge("POST", { "Content-Type": "text/csv" });
  expect(headers.get("X-CSRF-Token")).toBeNull();
  expect(headers.get("Content-Type")).toBe("text/csv");
  expect(headers.get("Accept")).toBe("application/json");
});
