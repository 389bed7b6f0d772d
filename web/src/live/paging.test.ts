import { describe, expect, it } from "vitest";
import { merged } from "./paging";
import type { Run } from "./types";

const runs = (...ids: number[]): Run[] => ids.map((id) => ({ id }) as Run);
const ids = (list: readonly Run[]): number[] => list.map(({ id }) => id);

describe("merged", () => {
  it("keeps older pages open under a newest page that was read again", () => {
    const { list, next } = merged(runs(9, 8, 7, 6, 5, 4), 4, { list: runs(10, 9, 8), next: 8 });
    expect(ids(list)).toEqual([10, 9, 8, 7, 6, 5, 4]);
    expect(next).toBe(4);
  });

  it("starts over where a stretch in between is not known", () => {
    const { list, next } = merged(runs(9, 8), 8, { list: runs(99, 98), next: 98 });
    expect([ids(list), next]).toEqual([[99, 98], 98]);
  });

  it("is the page where there is no other", () => {
    expect(merged(null, null, { list: runs(2, 1), next: null })).toEqual({ list: runs(2, 1), next: null });
    expect(ids(merged(runs(3, 2, 1), null, { list: [], next: null }).list)).toEqual([]);
    expect(ids(merged(runs(3, 2, 1), null, { list: runs(3, 1), next: null }).list)).toEqual([3, 1]);
  });
});
