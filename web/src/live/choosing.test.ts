import { describe, expect, it } from "vitest";
import { matching, ordered, tagsIn, tagsOf } from "./choosing";
import type { TestSummary } from "./types";

const test = (id: string, more: Partial<TestSummary> = {}): TestSummary =>
  ({ id, name: id, description: "", duration_s: 1, peak_force_n: 1, blocks: 1, tags: [], archived: false, last_run_at: null, ...more }) as TestSummary;

const TESTS = [
  test("sweep-10", { name: "Sweep 10 kN", tags: ["pump", "q1"], last_run_at: "2026-11-20T10:00:00Z" }),
  test("sweep-2", { name: "Sweep 2 kN", tags: ["pump"] }),
  test("step", { name: "Step", description: "Up and down", last_run_at: "2026-11-21T10:00:00Z" }),
  test("old", { archived: true, tags: ["gone"], last_run_at: "2026-11-22T10:00:00Z" }),
];
const ids = (tests: readonly TestSummary[]): string[] => tests.map(({ id }) => id);

describe("choosing a test", () => {
  it("finds every word, in name, description and tags", () => {
    expect(ids(matching(TESTS, { search: "sweep PUMP", tag: null }))).toEqual(["sweep-10", "sweep-2"]);
    expect(ids(matching(TESTS, { search: "down", tag: null }))).toEqual(["step"]);
    expect(matching(TESTS, { search: "sweep down", tag: null })).toEqual([]);
    expect(ids(matching(TESTS, { search: "", tag: "q1" }))).toEqual(["sweep-10"]);
  });

  it("never offers what is archived", () => {
    expect(ids(matching(TESTS, { search: "", tag: null }))).not.toContain("old");
    expect(tagsOf(TESTS)).toEqual(["pump", "q1"]);
  });

  it("has what ran last on top, the others by name as a person counts", () => {
    const { recent, others } = ordered(matching(TESTS, { search: "", tag: null }));
    expect(ids(recent)).toEqual(["step", "sweep-10"]);
    expect(ids(ordered([TESTS[1]!, test("s", { name: "Sweep 1 kN" })]).others)).toEqual(["s", "sweep-2"]);
    expect(ids(others)).toEqual(["sweep-2"]);
  });

  it("reads tags as they are typed", () => {
    expect(tagsIn(" q1, pump 7,pump  7,,a ")).toEqual(["a", "pump 7", "q1"]);
    expect(tagsIn("  ")).toEqual([]);
  });
});
