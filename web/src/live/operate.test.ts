import { describe, expect, it } from "vitest";
import type { Freshness } from "./freshness";
import { COMMANDS, guidance, missing, nextCommand, refusal, type Intent } from "./operate";
import { OPEN, type StartGate } from "./predicting";
import type { Command, Mode, RigStatus, TestSummary } from "./types";
import { modeWords } from "./words";

const FRESH: Freshness = { stale: false, trouble: null, age_s: 0.05 };
const LOST: Freshness = { stale: true, trouble: "link", age_s: 3 };
const STEP = {
  id: "step-2-kn",
  name: "Step 2 kN",
  description: "",
  duration_s: 4,
  peak_force_n: 2000,
  blocks: 3,
} as TestSummary;

const with_ = (chosen: TestSummary | null, gate: StartGate = OPEN): Intent => ({
  chosen,
  gate,
  notInCommand: null,
});

function status(mode: Mode, refusals: Partial<Record<Command, string>> = {}): RigStatus {
  const commands = Object.fromEntries(COMMANDS.map(({ command }) => [command, refusals[command] ?? null]));
  return { mode, commands } as unknown as RigStatus;
}

describe("refusal", () => {
  it("gives the reason of the server", () => {
    expect(refusal("hold", status("off", { hold: "Nothing is running" }), FRESH, with_(STEP))).toBe(
      "Nothing is running",
    );
    expect(refusal("reset", status("tripped"), FRESH, with_(null))).toBeNull();
  });

  it("wants a test before a start", () => {
    expect(refusal("start", status("ready"), FRESH, with_(null))).toBe("Choose a test first");
    expect(refusal("start", status("ready"), FRESH, with_(STEP))).toBeNull();
    expect(refusal("start", status("off", { start: "Not pressurised" }), FRESH, with_(null))).toBe(
      "Not pressurised",
    );
  });

  it("does not start what the prediction refuses, and says why", () => {
    const closed: StartGate = { is: "closed", why: "The force would pass 50 kN" };
    expect(refusal("start", status("ready"), FRESH, with_(STEP, closed))).toBe("The force would pass 50 kN");
    expect(refusal("hold", status("running"), FRESH, with_(STEP, closed))).toBeNull();
    expect(nextCommand(status("ready"), FRESH, with_(STEP, closed))).toBeNull();
    expect(guidance(status("ready"), FRESH, with_(STEP, { is: "reason", why: "Near a limit" }))).toMatch(/reason/);
  });

  it("wants command once nothing else is in the way, and for Stop never", () => {
    const outside: Intent = { ...with_(null), notInCommand: "Take command first: C" };
    expect(refusal("reset", status("tripped"), FRESH, outside)).toBe("Take command first: C");
    expect(refusal("hold", status("off", { hold: "Nothing is running" }), FRESH, outside)).toBe("Nothing is running");
    expect(refusal("stop", status("running"), FRESH, outside)).toBeNull();
    expect(guidance(status("tripped"), FRESH, outside)).toBe("Take command first: C");
    expect(nextCommand(status("tripped"), FRESH, outside)).toBeNull();
  });

  it("refuses everything but Stop while no data arrive", () => {
    expect(refusal("start", status("ready"), LOST, with_(STEP))).toBe("No link to the server");
    expect(refusal("stop", null, LOST, with_(null))).toBeNull();
  });

  it("does not take a command that the server never mentioned for allowed", () => {
    expect(refusal("shutdown", status("ready"), FRESH, with_(STEP))).toBe("Not offered by this server");
  });
});

describe("nextCommand", () => {
  it.each([
    ["tripped", "reset"],
    ["off", "pressurise"],
    ["ready", "start"],
    ["holding", "resume"],
    ["pressurising", null],
    ["running", null],
    ["stopping", null],
    ["lost", null],
  ] as const)("when %s is %s", (mode, command) => {
    expect(nextCommand(status(mode), FRESH, with_(STEP))).toBe(command);
  });

  it("is nothing where that command would be refused", () => {
    expect(nextCommand(status("tripped", { reset: "Supply pressure still high" }), FRESH, with_(STEP))).toBeNull();
    expect(nextCommand(status("ready"), FRESH, with_(null))).toBeNull();
    expect(nextCommand(status("ready"), LOST, with_(STEP))).toBeNull();
  });
});

describe("guidance", () => {
  it("says what to do, or why it cannot be done", () => {
    expect(guidance(status("ready"), FRESH, with_(STEP))).toBe("Press Start to run this test.");
    expect(guidance(status("ready"), FRESH, with_(null))).toBe("Choose a test first");
    expect(guidance(status("tripped", { reset: "Supply pressure still high" }), FRESH, with_(null))).toBe(
      "Supply pressure still high",
    );
    expect(guidance(status("ready"), LOST, with_(STEP))).toMatch(/Stop is always sent/);
  });
});

describe("missing", () => {
  const permissives = [
    { name: "pressure", met: false, text: "Press Pressurise" },
    { name: "storage", met: true, text: "There is room" },
  ];
  const at = (run: unknown): RigStatus => ({ mode: "off", permissives, run }) as unknown as RigStatus;

  it("is what a start still needs, while data arrive and nothing runs", () => {
    expect(missing(at(null), FRESH).map(({ name }) => name)).toEqual(["pressure"]);
    expect(missing(at({ id: 1 }), FRESH)).toEqual([]);
    expect(missing(at(null), LOST)).toEqual([]);
    expect(missing(null, FRESH)).toEqual([]);
  });
});

describe("modeWords", () => {
  it("never shows a mode that is no longer known", () => {
    expect(modeWords(status("running"), FRESH)).toEqual({ text: "Running", tone: "active" });
    expect(modeWords(status("tripped"), FRESH)).toEqual({ text: "Tripped", tone: "trip" });
    expect(modeWords(status("running"), LOST).text).toBe("Link lost");
    expect(modeWords(status("running"), { ...LOST, trouble: "loop" }).text).toBe("Loop lost");
    expect(modeWords(null, { stale: true, trouble: "connecting", age_s: null }).text).toBe("Connecting");
  });
});
