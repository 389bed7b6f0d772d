import { describe, expect, it } from "vitest";
import type { Json } from "./tree";
import { changesBetween, linesOf, textChanges } from "./difference";

describe("changesBetween", () => {
  it("names what was added, removed and changed", () => {
    const before: Json = { name: "a", blocks: [{ kind: "hold", duration_s: 1 }], description: "x" };
    const after: Json = { name: "b", blocks: [{ kind: "hold", duration_s: 1 }, { kind: "ramp" }] };
    expect(changesBetween(before, after)).toEqual([
      { path: "name", before: "a", after: "b", kind: "changed" },
      { path: "blocks[1]", after: { kind: "ramp" }, kind: "added" },
      { path: "description", before: "x", kind: "removed" },
    ]);
    expect(changesBetween(before, structuredClone(before))).toEqual([]);
  });
});

describe("textChanges", () => {
  it("gives both texts back, and keeps what they share", () => {
    const [before, after] = ["a\nb\nc\nd", "a\nx\nc\nd\ne"];
    const lines = textChanges(before, after);
    const side = (other: string): string =>
      lines.filter((line) => line.sign !== other).map((line) => line.text).join("\n");
    expect(side("+")).toBe(before);
    expect(side("-")).toBe(after);
    expect(lines.filter((line) => line.sign === " ").map((line) => line.text)).toEqual(["a", "c", "d"]);
  });
});

describe("linesOf", () => {
  it("reads a unified difference without the names of its files", () => {
    expect(linesOf("--- a\n+++ b\n@@ -1 +1 @@\n-old\n+new\n same\n").map((line) => line.sign + line.text)).toEqual([
      "@@@ -1 +1 @@",
      "-old",
      "+new",
      " same",
    ]);
  });
});
