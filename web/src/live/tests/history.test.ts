import { describe, expect, it } from "vitest";
import { amend, begin, change, redo, undo } from "./history";

describe("history", () => {
  it("goes back and forth over every change", () => {
    let history = begin("a");
    history = change(history, "b", null, 0);
    history = change(history, "c", null, 1);
    history = undo(history);
    expect(history.now).toBe("b");
    expect(undo(undo(history)).now).toBe("a");
    expect(redo(history).now).toBe("c");
    expect(redo(redo(history)).now).toBe("c");
  });

  it("takes typing into one field as one change, and a pause or another field as the next", () => {
    let history = begin("");
    history = change(history, "1", "name", 0);
    history = change(history, "12", "name", 900);
    history = change(history, "123", "name", 1800);
    expect(undo(history).now).toBe("");
    history = change(history, "x", "other", 1900);
    expect(undo(history).now).toBe("123");
    history = change(history, "xy", "other", 5000);
    expect(undo(history).now).toBe("x");
  });

  it("never joins what came before an undo", () => {
    let history = change(change(begin("a"), "b", "name", 0), "c", null, 10);
    history = change(undo(history), "d", "name", 20);
    expect(undo(history).now).toBe("b");
    expect(redo(history).now).toBe("d");
  });

  it("amends without a step, and forgets what is very old", () => {
    expect(undo(amend(change(begin(0), 1, null, 0), 5)).now).toBe(0);
    let history = begin(0);
    for (let i = 1; i <= 500; i += 1) history = change(history, i, null, i);
    for (let i = 0; i < 500; i += 1) history = undo(history);
    expect(history.now).toBe(300);
  });
});
