import { describe, expect, it } from "vitest";
import { lastSeen, remember } from "./lastSeen";

function store(text: string | null = null): Pick<Storage, "getItem" | "setItem"> {
  return { getItem: () => text, setItem: (_, value) => void (text = value) };
}

describe("how a run was seen last", () => {
  it("is known again, and forgotten when it was nothing special", () => {
    const kept = store();
    remember(kept, 7, "from=1&to=2");
    remember(kept, 8, "view=settings");
    expect(lastSeen(kept, 7)).toBe("from=1&to=2");
    remember(kept, 7, "");
    expect([lastSeen(kept, 7), lastSeen(kept, 8)]).toEqual(["", "view=settings"]);
  });

  it("is bounded, and survives what it cannot read", () => {
    const kept = store();
    for (let run = 0; run < 200; run += 1) remember(kept, run, `from=${run}`);
    expect([lastSeen(kept, 199), lastSeen(kept, 150), lastSeen(kept, 149)]).toEqual(["from=199", "from=150", ""]);
    expect(lastSeen(store("not json"), 1)).toBe("");
    expect(lastSeen(store('{"a":1}'), 1)).toBe("");
  });
});
