import { describe, expect, it } from "vitest";
import type { Lease } from "../types";
import { follow, holderWords, lossWords, notInCommand, sinceWords, standingOf } from "./standing";

const lease = (change: Partial<Lease> = {}): Lease => ({
  epoch: 7,
  holder: "Ann",
  holder_id: "session:ann",
  role: "operator",
  since: "2024-11-22T14:00:00Z",
  reason: "",
  expires_in_s: 9,
  requests: [],
  ...change,
});
const ME = "session:me";
const HELD = { epoch: 7, seen: true };
const mine = lease({ holder: "Me", holder_id: ME });

describe("standingOf", () => {
  it("tells this window from another one of the same person, and both from somebody else", () => {
    expect(holderWords(standingOf(null, null, ME))).toBe("Nobody");
    expect(holderWords(standingOf(mine, HELD, ME))).toBe("You");
    expect(holderWords(standingOf(mine, null, ME))).toBe("You, elsewhere");
    expect(holderWords(standingOf(mine, { epoch: 6, seen: true }, ME))).toBe("You, elsewhere");
    expect(holderWords(standingOf(lease(), null, ME))).toBe("Ann");
  });
});

describe("notInCommand", () => {
  it("says what would help, and nothing to whoever is in command", () => {
    expect(notInCommand(standingOf(mine, HELD, ME), "operator")).toBeNull();
    expect(notInCommand(standingOf(null, null, ME), "operator")).toBe("Take command first: C");
    expect(notInCommand(standingOf(lease(), null, ME), "admin")).toBe("Ann is in command. Ask for command: C");
    expect(notInCommand(standingOf(mine, null, ME), "operator")).toContain("another window");
  });

  it("names the role first: no control helps a viewer", () => {
    expect(notInCommand(standingOf(null, null, ME), "viewer")).toBe("Needs an operator; you are a viewer");
  });
});

describe("follow", () => {
  it("keeps what the status confirms", () => {
    expect(follow({ epoch: 7, seen: false }, mine, ME, false)).toEqual({ hold: HELD });
    expect(follow(HELD, mine, ME, false).hold).toBe(HELD);
  });

  it("waits for a status that knows of the grant", () => {
    const granted = { epoch: 7, seen: false };
    expect(follow(granted, null, ME, false)).toEqual({ hold: granted });
    expect(follow(granted, lease({ epoch: 6 }), ME, false)).toEqual({ hold: granted });
  });

  it("says when command has passed, also to another window of the same person", () => {
    const next = lease({ epoch: 8 });
    expect(follow(HELD, next, ME, false)).toEqual({ hold: null, lost: { to: next } });
    expect(follow({ epoch: 7, seen: false }, next, ME, false).lost).toEqual({ to: next });
    expect(follow(HELD, { ...mine, epoch: 8 }, ME, false).lost).toBeDefined();
    expect(follow(HELD, null, ME, false)).toEqual({ hold: null, lost: { to: null } });
  });

  it("takes what this window asked for, and nothing else", () => {
    expect(follow(null, mine, ME, true)).toEqual({ hold: HELD, given: true });
    expect(follow(null, mine, ME, false)).toEqual({ hold: null });
    expect(follow(null, lease(), ME, true)).toEqual({ hold: null });
  });
});

describe("words", () => {
  it("say to whom command has passed, and why", () => {
    expect(lossWords(null, ME)).toContain("has ended here");
    expect(lossWords(lease({ reason: "shift" }), ME)).toBe("Control has passed to Ann, operator. Reason: shift");
    expect(lossWords(mine, ME)).toContain("another window");
  });

  it("count minutes and hours; a clock that lags is no matter", () => {
    const at = (minutes: number): string => sinceWords("2024-11-22T14:00:00Z", Date.UTC(2024, 10, 22, 14, minutes));
    expect([at(-3), at(0), at(4), at(119), at(125)]).toEqual(["just now", "just now", "4\u00a0min", "119\u00a0min", "2\u00a0h"]);
  });
});
