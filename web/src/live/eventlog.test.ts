import { describe, expect, it } from "vitest";
import { EVENTS_KEPT, inOrder, logged, type EventLog } from "./eventlog";
import type { RigEvent } from "./types";

const event = (kind: string, code: string, tick = 0): RigEvent => ({
  kind,
  code,
  tick,
  time_s: tick / 4000,
  text: `${code} at ${tick}`,
});
const log = (...events: RigEvent[]): EventLog => events.reduce<EventLog>(logged, []);

describe("the log of events", () => {
  it("has the newest on top, each with its own number", () => {
    const lines = log(event("mode", "off", 1), event("mode", "ready", 2));
    expect(lines.map((line) => line.code)).toEqual(["ready", "off"]);
    expect(new Set(lines.map((line) => line.serial)).size).toBe(2);
  });

  it("counts missed deadlines in a row on one line, with the last time", () => {
    const late = [1, 2, 3].map((tick) => event("deadlines_missed", "deadlines_missed", tick));
    const lines = log(event("mode", "ready"), ...late);
    expect(lines).toHaveLength(2);
    expect(lines[0]).toMatchObject({ times: 3, tick: 3 });
  });

  it("counts what a frequency response leaves out on one line, late ticks between or not, and its commands on none", () => {
    const left = (tick: number): RigEvent[] => [event("command", "skip", tick), event("skipped", String(tick), tick)];
    const late = event("deadlines_missed", "deadlines_missed", 3);
    const lines = log(event("mode", "running"), ...left(1), ...left(2), late, ...left(4));
    expect(lines.map(({ kind, times }) => [kind, times])).toEqual([
      ["skipped", 3],
      ["deadlines_missed", 1],
      ["mode", 1],
    ]);
    expect(new Set(lines.map(({ serial }) => serial)).size).toBe(3);
    expect(log(...left(1), event("block", "1", 2), ...left(3)).map(({ kind }) => kind)).toEqual(["skipped", "block", "skipped"]);
  });

  it("never joins trips or refusals", () => {
    expect(log(event("trip", "force"), event("trip", "force"))).toHaveLength(2);
    expect(log(event("refusal", "start"), event("refusal", "start"))).toHaveLength(2);
  });

  it("stays bounded, and keeps a trip while anything else can go", () => {
    let lines = log(event("trip", "force_error", 1));
    for (let tick = 2; tick < 5000; tick += 1) lines = logged(lines, event("mode", `m${tick}`, tick));
    expect(lines).toHaveLength(EVENTS_KEPT);
    expect(lines.at(-1)!.code).toBe("force_error");
    for (let tick = 0; tick < 500; tick += 1) lines = logged(lines, event("trip", `t${tick}`, tick));
    expect(lines).toHaveLength(EVENTS_KEPT);
  });

  it("lists those of a run in the order in which they happened", () => {
    expect(inOrder([event("mode", "running", 0), event("block", "1", 9)]).map((line) => line.tick)).toEqual([
      0, 9,
    ]);
  });
});
