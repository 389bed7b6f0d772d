import { describe, expect, it } from "vitest";
import { seenOf, writeSeen, type Seen } from "./runQuery";

const USUAL: Seen = { view: "charts", shown: ["force", "displacement", "valve"], xy: false, predicted: false };

describe("what of a run is shown", () => {
  it("comes back from the address as it was", () => {
    const seen: Seen = { view: "results", shown: ["force", "velocity"], xy: true, predicted: true };
    const query = new URLSearchParams("from=1&to=2");
    writeSeen(query, seen);
    expect(seenOf(query)).toEqual(seen);
    expect(query.get("from")).toBe("1");
  });

  it("needs no words where it is as usual", () => {
    const query = new URLSearchParams("view=results&xy=1&show=valve");
    writeSeen(query, USUAL);
    expect(query.toString()).toBe("");
    expect(seenOf(query)).toEqual(USUAL);
  });

  it("takes nonsense for the usual", () => {
    expect(seenOf(new URLSearchParams("view=x&show=y,z&xy=2"))).toEqual(USUAL);
  });
});
