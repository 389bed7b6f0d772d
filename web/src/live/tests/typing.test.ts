import { describe, expect, it } from "vitest";
import { continued } from "./typing";

describe("Enter in YAML", () => {
  const after = (text: string): string => {
    const at = text.indexOf("|");
    const out = continued(text.replace("|", ""), at, at);
    return `${out.text.slice(0, out.at)}|${out.text.slice(out.at)}`;
  };

  it("begins the next line where this one began, deeper behind a key without a value", () => {
    expect(after("a: 1|")).toBe("a: 1\n|");
    expect(after("blocks:|\nb: 1")).toBe("blocks:\n  |\nb: 1");
    expect(after("x:\n  - a: 1|\n")).toBe("x:\n  - a: 1\n  |\n");
    expect(after("  a: |1")).toBe("  a: \n    |1");
  });

  it("takes the place of what is selected", () => {
    expect(continued("abc", 1, 2)).toEqual({ text: "a\nc", at: 2 });
  });
});
