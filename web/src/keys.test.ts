import { describe, expect, it } from "vitest";
import { actionOf, takesText, VIEW_KEYS, type Press } from "./keys";
import { COMMANDS } from "./live/operate";
import { entryOf, routeOf } from "./router";

const press = (key: string, change: Partial<Press> = {}): ReturnType<typeof actionOf> =>
  actionOf({
    key,
    repeat: false,
    modified: false,
    typing: false,
    operating: true,
    singleKeys: true,
    ...change,
  });

describe("actionOf", () => {
  it("stops on Escape, from anywhere but a text field, where it first leaves the field", () => {
    expect(press("Escape")).toEqual({ kind: "stop" });
    expect(press("Escape", { singleKeys: false })).toEqual({ kind: "stop" });
    expect(press("Escape", { typing: true })).toEqual({ kind: "leave-field" });
  });

  it("gives commands on single keys", () => {
    expect(press("r")).toEqual({ kind: "command", command: "reset" });
    expect(press("P")).toEqual({ kind: "command", command: "pressurise" });
    expect(press("?")).toEqual({ kind: "help" });
  });

  it("gives none while typing, while held down, with a modifier, or when turned off", () => {
    for (const change of [{ typing: true }, { repeat: true }, { modified: true }, { singleKeys: false }]) {
      for (const { key } of [...COMMANDS, ...VIEW_KEYS]) expect(press(key, change)).toBeNull();
    }
  });

  it("gives commands only where they can be seen, and stops everywhere", () => {
    expect(press("s", { operating: false })).toBeNull();
    expect(press("f", { operating: false })).toBeNull();
    expect(press("1", { operating: false })).toEqual({ kind: "operate" });
    expect(press("Escape", { operating: false })).toEqual({ kind: "stop" });
  });

  it("has each key once", () => {
    const keys = [...COMMANDS, ...VIEW_KEYS].map(({ key }) => key);
    expect(new Set(keys).size).toBe(keys.length);
  });
});

describe("entryOf", () => {
  it("lights the list that a page belongs to", () => {
    expect(entryOf({ page: "run", id: 1, query: "" })).toBe("runs");
    expect(entryOf({ page: "first-out", id: 1, query: "" })).toBe("interlocks");
    expect(entryOf({ page: "system", tab: "audit" })).toBe("system");
  });
});

describe("takesText", () => {
  it("tells text fields from buttons and boxes", () => {
    expect(takesText({ tagName: "INPUT", type: "text" })).toBe(true);
    expect(takesText({ tagName: "TEXTAREA" })).toBe(true);
    expect(takesText({ tagName: "INPUT", type: "radio" })).toBe(false);
    expect(takesText({ tagName: "BUTTON", type: "submit" })).toBe(false);
    expect(takesText(null)).toBe(false);
  });
});

describe("routeOf", () => {
  it("reads addresses, and falls back to Operate", () => {
    expect(routeOf("#/runs")).toEqual({ page: "runs", query: "" });
    expect(routeOf("#/runs?search=50%20Hz&tag=a?b")).toEqual({
      page: "runs",
      query: "search=50%20Hz&tag=a?b",
    });
    expect(routeOf("#/runs/12?from=1.5")).toEqual({ page: "run", id: 12, query: "from=1.5" });
    expect(routeOf("#/runs/none")).toEqual({ page: "runs", query: "" });
    expect(routeOf("#/tests")).toEqual({ page: "tests" });
    expect(routeOf("#/tests/a%20b")).toEqual({ page: "test", id: "a b" });
    expect(routeOf("#/tests/%")).toEqual({ page: "test", id: "%" });
    expect(routeOf("#/new-test")).toEqual({ page: "test", id: null });
    expect(routeOf("#/interlocks")).toEqual({ page: "interlocks" });
    expect(routeOf("#/interlocks/first-outs/7?tab=replay")).toEqual({
      page: "first-out",
      id: 7,
      query: "tab=replay",
    });
    expect(routeOf("#/interlocks/first-outs/none")).toEqual({ page: "interlocks" });
    expect(routeOf("#/drills")).toEqual({ page: "drills" });
    expect(routeOf("#/system/audit")).toEqual({ page: "system", tab: "audit" });
    expect(routeOf("#/system")).toEqual({ page: "system", tab: "users" });
    for (const hash of ["", "#", "#/", "#/operate", "#/nonsense", "#/constructor"])
      expect(routeOf(hash)).toEqual({ page: "operate" });
  });
});
