import { describe, expect, it } from "vitest";
import { auditChanges, auditQuery, isFiltered, NO_FILTERS } from "./audit";

describe("auditQuery", () => {
  it("asks only for what was filled in", () => {
    expect(auditQuery(NO_FILTERS)).toBe("limit=50");
    expect(auditQuery({ ...NO_FILTERS, who: " Ann ", action: "tests." })).toBe("limit=50&who=Ann&action=tests.");
    expect(isFiltered(NO_FILTERS)).toBe(false);
    expect(isFiltered({ ...NO_FILTERS, to: "2024-11-22" })).toBe(true);
  });

  it("takes whole days of the reader's clock, the last one included", () => {
    const query = new URLSearchParams(auditQuery({ ...NO_FILTERS, from: "2024-11-30", to: "2024-11-30" }));
    const hours = (Date.parse(query.get("until")!) - Date.parse(query.get("since")!)) / 3_600_000;
    expect(hours).toBe(24);
    expect(new Date(query.get("since")!).getHours()).toBe(0);
  });
});

describe("auditChanges", () => {
  it("shows what has changed, and only that", () => {
    expect(auditChanges({ before: { role: "viewer", name: "Bo" }, after: { role: "operator", name: "Bo" } })).toEqual([
      { path: "role", before: "viewer", after: "operator" },
    ]);
  });

  it("shows what was made or removed leaf by leaf", () => {
    expect(auditChanges({ before: null, after: { name: "Bo", tags: ["a", ""] } })).toEqual([
      { path: "name", before: "—", after: "Bo" },
      { path: "tags[0]", before: "—", after: "a" },
      { path: "tags[1]", before: "—", after: "(empty)" },
    ]);
    expect(auditChanges({ before: { limit: { force_n: 5 } }, after: null })).toEqual([
      { path: "limit.force_n", before: "5", after: "—" },
    ]);
  });

  it("has nothing to show for an act that changed no record", () => {
    expect(auditChanges({ before: null, after: null })).toEqual([]);
  });
});
