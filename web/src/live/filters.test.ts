import { describe, expect, it } from "vitest";
import { apiQuery, filterCount, filtersOf, isFiltered, NO_FILTERS, queryOf, type Filters } from "./filters";

const ALL: Filters = {
  search: "50 Hz & more",
  test_id: "step",
  tag: "pump/7",
  outcome: "tripped",
  verdict: "fail",
  operator: "Ä. Müller",
  since: "2026-11-20",
  until: "2026-11-22",
};

describe("filters in the address", () => {
  it("come back as they were", () => {
    expect(filtersOf(queryOf(ALL))).toEqual(ALL);
    expect(filtersOf(queryOf(NO_FILTERS))).toEqual(NO_FILTERS);
    expect(queryOf(NO_FILTERS)).toBe("");
  });

  it("leave out blanks, strangers, and days that are none", () => {
    expect(queryOf({ ...NO_FILTERS, search: "  " })).toBe("");
    expect(filtersOf("nonsense=1&since=yesterday&until=2026-13-45&tag=x")).toEqual({ ...NO_FILTERS, tag: "x" });
  });

  it("are counted beside the search", () => {
    expect(filterCount(ALL)).toBe(7);
    expect(filterCount({ ...NO_FILTERS, search: "x" })).toBe(0);
    expect(isFiltered({ ...NO_FILTERS, search: "x" })).toBe(true);
    expect(isFiltered(NO_FILTERS)).toBe(false);
  });
});

describe("what the server is asked", () => {
  it("is from the first moment of a day to the last of another, on the reader's clock", () => {
    const asked = new URLSearchParams(apiQuery(ALL));
    expect(asked.get("since")).toBe(new Date(2026, 10, 20).toISOString());
    expect(asked.get("until")).toBe(new Date(2026, 10, 23).toISOString());
    expect(asked.get("search")).toBe("50 Hz & more");
  });
});
