import { describe, expect, it } from "vitest";
import { legible, marksOf, type Mark } from "./marks";

describe("marks", () => {
  it("are blocks, trips and what people did", () => {
    const events = [
      { kind: "block", code: "0", time_s: 0 },
      { kind: "block", code: "-1", time_s: 1 },
      { kind: "command", code: "hold", time_s: 2 },
      { kind: "mode", code: "holding", time_s: 2 },
      { kind: "command", code: "skip", time_s: 2.5 },
      { kind: "trip", code: "force_high", time_s: 3 },
    ];
    expect(marksOf(events).map(({ kind, label }) => [kind, label])).toEqual([
      ["block", "1"],
      ["event", ""],
      ["trip", ""],
    ]);
  });

  it("are thinned where they would run into each other, trips never", () => {
    const blocks: Mark[] = Array.from({ length: 100 }, (_, i) => ({ time_s: i, kind: "block", label: String(i) }));
    const trip: Mark = { time_s: 50.1, kind: "trip", label: "" };
    const drawn = legible([...blocks.slice(0, 51), trip, ...blocks.slice(51)], (time_s) => 2 * time_s, 200, 20);
    expect(drawn.filter(({ mark }) => mark.kind === "block").map(({ mark }) => mark.time_s)).toEqual([
      0, 10, 20, 30, 40, 50, 60, 70, 80, 90,
    ]);
    expect(drawn.some(({ mark }) => mark === trip)).toBe(true);
    expect(legible(blocks, (time_s) => time_s - 50, 10, 1)).toHaveLength(11);
  });
});
