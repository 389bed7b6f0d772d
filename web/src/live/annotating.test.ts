import { describe, expect, it } from "vitest";
import { changesOf, draftOf, isChanged, rebased } from "./annotating";

const READ = { operator: "Ada", tags: ["pump", "q1"], notes: "First" };

describe("editing what the book says of a run", () => {
  it("sends only what was changed", () => {
    const draft = draftOf(READ);
    expect(isChanged(READ, draft)).toBe(false);
    expect(changesOf(READ, { ...draft, tags: "pump,q1 , leak" })).toEqual({ tags: ["leak", "pump", "q1"] });
    expect(changesOf(READ, { ...draft, tags: " q1 ,pump," })).toEqual({});
    expect(changesOf(READ, { ...draft, notes: "" })).toEqual({ notes: "" });
  });

  it("keeps mine where I wrote, and takes theirs where I did not", () => {
    const mine = { ...draftOf(READ), notes: "Mine" };
    const theirs = { operator: "Bo", tags: ["pump"], notes: "Theirs" };
    expect(rebased(READ, mine, theirs)).toEqual({ operator: "Bo", tags: "pump", notes: "Mine" });
  });
});
