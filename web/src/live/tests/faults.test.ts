import { describe, expect, it } from "vitest";
import { draftIds, dropDraft, keepDraft, keptDraft } from "./drafts";
import { faultsAt, faultsBeside, faultsByLine, faultsWithin, inFormUnits } from "./faults";
import { BLOCK_KINDS, itemsFor, keysOf, kindOf, MOTION_KINDS } from "./kinds";
import type { Fault } from "./types";

const fault = (path: string, line: number | null = null): Fault => ({
  ...{ path, line, value: null, limit: null, unit: null },
  message: `wrong ${path}`,
});
const FAULTS = [fault("blocks[1].to_n", 7), fault("blocks[1]", 6), fault("blocks[11].to_n", 7), fault("name")];

describe("faults", () => {
  it("are shown at their field, and nowhere else", () => {
    expect(faultsAt(FAULTS, ["blocks", 1, "to_n"])).toEqual([FAULTS[0]]);
    expect(faultsAt(FAULTS, ["blocks", 1])).toEqual([FAULTS[1]]);
    expect(faultsWithin(FAULTS, ["blocks", 1])).toEqual([FAULTS[0], FAULTS[1]]);
    expect(faultsBeside(FAULTS, ["blocks", 1], ["to_n"])).toEqual([FAULTS[1]]);
  });

  it("are shown at their line, together where there are several", () => {
    const lines = faultsByLine(FAULTS);
    expect([...lines.keys()].sort()).toEqual([6, 7]);
    expect(lines.get(7)).toBe("blocks[1].to_n: wrong blocks[1].to_n\nblocks[11].to_n: wrong blocks[11].to_n");
  });
});

describe("a sentence in the units of the form", () => {
  it("turns figures in SI, and nothing else", () => {
    expect(inFormUnits("60,000 N must be at most 50,000 N")).toBe("60 kN must be at most 50 kN");
    expect(inFormUnits("0.05 m at 50 Hz reaches 15.708 m/s")).toBe("50 mm at 50 Hz reaches 15708 mm/s");
    expect(inFormUnits("1e+12 N/s must be at most 2,000,000 N/s")).toBe("1000000000 kN/s must be at most 2000 kN/s");
    for (const text of ["3 minutes, 5 Nights", "v2 N", "must be a number, is the text '5'"])
      expect(inFormUnits(text)).toBe(text);
  });
});

describe("kinds", () => {
  it("begin with every field that has no default, and say in a line what they do", () => {
    for (const [where, kinds] of [["blocks", BLOCK_KINDS], ["motion", MOTION_KINDS]] as const) {
      for (const info of kinds) {
        const block = info.make();
        expect(kindOf(block, where)).toBe(info);
        expect(info.summary(block)).not.toMatch(/undefined|NaN|—/);
        for (const item of itemsFor(info, block)) {
          if (item.form === "field" && item.field.empty === undefined) expect(block).toHaveProperty(item.field.key);
          if (item.form === "either")
            expect(item.fields.filter((entry) => entry.key in block)).toHaveLength(1);
        }
        expect(new Set(keysOf(info, block)).size).toBe(keysOf(info, block).length);
      }
    }
  });
});

describe("drafts", () => {
  const store = (): Storage => {
    const kept = new Map<string, string>();
    return {
      getItem: (key: string) => kept.get(key) ?? null,
      setItem: (key: string, value: string) => void kept.set(key, value),
      removeItem: (key: string) => void kept.delete(key),
      key: (at: number) => [...kept.keys()][at] ?? null,
      get length() {
        return kept.size;
      },
    } as Storage;
  };
  const draft = { ...{ basedOn: 2, name: "a", yaml: "name: a", definition: {} }, from: "yaml", keptAt: "" } as const;

  it("come back, of a test and of a new one", () => {
    const kept = store();
    kept.setItem("forcerig.theme", "dark");
    expect(keepDraft(kept, "a b", draft)).toBe(true);
    keepDraft(kept, null, draft);
    expect(keptDraft(kept, "a b")).toEqual(draft);
    expect(draftIds(kept)).toEqual(["a b", null]);
    dropDraft(kept, "a b");
    expect(keptDraft(kept, "a b")).toBeNull();
  });

  it("are none where they cannot be read or kept", () => {
    const kept = store();
    kept.setItem("forcerig.draft:x", "{");
    expect(keptDraft(kept, "x")).toBeNull();
    const full = { ...store(), setItem: () => { throw new DOMException("full", "QuotaExceededError"); } };
    expect(keepDraft(full, "x", draft)).toBe(false);
  });
});
