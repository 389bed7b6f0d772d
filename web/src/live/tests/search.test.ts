import { describe, expect, it } from "vitest";
import { filtered, tagsIn, tagsOf } from "./search";
import type { CatalogueEntry } from "./types";

const entry = (name: string, tags: string[] = []): CatalogueEntry => ({
  ...{ id: name.toLowerCase(), name, tags, description: "", author: "", blocks: 1, revision: 1 },
  ...{ duration_s: 1, peak_force_n: 1, archived: false, updated_at: "", runs: 0, last_run_at: null },
});
const LIST = [entry("Step of 2 kN", ["paper", "step"]), entry("Prüfung Ölpumpe", ["pump"]), entry("Layers", ["paper"])];
const names = (search: string, tag = ""): string[] => filtered(LIST, search, tag).map((test) => test.name);

describe("search", () => {
  it("finds every word, in any order, with or without accents, in names and tags", () => {
    expect(names("kn step")).toEqual(["Step of 2 kN"]);
    expect(names("olpumpe")).toEqual(["Prüfung Ölpumpe"]);
    expect(names(" paper ")).toEqual(["Step of 2 kN", "Layers"]);
    expect(names("step pump")).toEqual([]);
    expect(names("", "paper")).toEqual(["Step of 2 kN", "Layers"]);
    expect(names("")).toHaveLength(3);
  });

  it("knows every tag once, and reads tags as typed", () => {
    expect(tagsOf(LIST)).toEqual(["paper", "pump", "step"]);
    expect(tagsIn(" a, b c,,a ")).toEqual(["a", "b c"]);
  });
});
