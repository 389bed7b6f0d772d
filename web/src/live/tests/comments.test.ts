import { describe, expect, it } from "vitest";
import { commentsIn } from "./comments";

describe("commentsIn", () => {
  it("finds comments, whole lines and behind values", () => {
    expect(commentsIn("# first\na: 1  # second\nb: [1, 2]   #third")).toEqual(["first", "second", "third"]);
  });

  it("finds none in text", () => {
    const none = [
      "a: no#comment",
      "a: 'it''s # not'",
      'a: "say \\" # not"',
      "a: >-\n  text # of a scalar\n\n  # this too",
      "- |\n  # text",
      "a: don't",
    ];
    for (const yaml of none) expect(commentsIn(yaml), yaml).toEqual([]);
  });

  it("finds what comes after a block scalar", () => {
    expect(commentsIn("a: >-\n  # text\nb: 1 # comment")).toEqual(["comment"]);
    expect(commentsIn("a: don't # here")).toEqual(["here"]);
  });
});
