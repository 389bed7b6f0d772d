import { expect, it } from "vitest";
import { aDetector } from "./aDetector";
import { drop, keep, kept } from "./kept";

function store(): Pick<Storage, "getItem" | "setItem" | "removeItem"> {
  const map = new Map<string, string>();
  return {
    getItem: (key) => map.get(key) ?? null,
    setItem: (key, value) => void map.set(key, value),
    removeItem: (key) => void map.delete(key),
  };
}

it("keeps a draft over a reload, and takes nothing that is none", () => {
  const browser = store();
  const draft = { basedOn: 3, detectors: [aDetector()], keptAt: "2024-11-22T14:00:00Z" };
  keep(browser, draft);
  expect(kept(browser)).toEqual(draft);
  drop(browser);
  expect(kept(browser)).toBeNull();
  for (const nonsense of ["{", "null", '{"basedOn": 1}', "[]"]) {
    browser.setItem("forcerig.interlocks-draft", nonsense);
    expect(kept(browser)).toBeNull();
  }
});
