import { describe, expect, it } from "vitest";
import { atLeast, lacking, ROLES } from "./roles";

describe("roles", () => {
  it("each include those before them", () => {
    for (const [i, role] of ROLES.entries())
      for (const [j, needed] of ROLES.entries()) expect(atLeast(role, needed)).toBe(i >= j);
    expect(atLeast(null, "viewer")).toBe(false);
  });

  it("say which one is needed, and which one asks", () => {
    expect(lacking("viewer", "operator")).toBe("Needs an operator; you are a viewer");
    expect(lacking("operator", "engineer")).toBe("Needs an engineer; you are an operator");
    expect(lacking(null, "viewer")).toBe("Needs a viewer: sign in");
    expect(lacking("admin", "engineer")).toBeNull();
  });
});
