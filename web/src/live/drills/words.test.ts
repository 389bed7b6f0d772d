import { describe, expect, it } from "vitest";
import type { Drill, DrillSummary } from "./types";
import { amountQuantity, amountRefusal, announcement, boundsText, reactionFigures, reactionText, tally, timeText } from "./words";

const plain = (text: string): string => text.replaceAll("\u00a0", " ");
const aDrill = (changes: Partial<Drill> = {}): Drill => ({
  fault: "load_cell_open",
  name: "Load cell open",
  doc: "A wire breaks.",
  amount: "rail: +1 or -1",
  unit: "-",
  low: -1,
  high: 1,
  default: 1,
  ready: { first_outs: ["force", "load_cell"], within_s: 1e-3, sees: "It trips." },
  test: { first_outs: [], within_s: 3, sees: "Nothing." },
  why_not: null,
  ...changes,
});

describe("a drill in words", () => {
  it("names its amount with its bounds, in what one types", () => {
    const late = aDrill({ unit: "s", low: 1e-4, high: 0.05, amount: "how long" });
    expect(plain(boundsText(late))).toBe("0.1 ms … 50 ms, not 0: how long");
    expect(amountQuantity(aDrill({ unit: "m", high: 2e-4 })).symbol).toBe("mm");
    expect(amountQuantity(aDrill({ unit: "N/s", high: 2e4 })).symbol).toBe("kN/s");
    expect(plain(boundsText(aDrill()))).toBe("−1 … 1, not 0: rail: +1 or -1");
  });

  it("refuses what cannot be given, and says what can", () => {
    expect(amountRefusal(aDrill(), 0.5)).toBeNull();
    for (const wrong of [null, 0, 1.1, -2]) expect(amountRefusal(aDrill(), wrong)).not.toBeNull();
  });

  it("says what must follow, and what a press will do", () => {
    expect(plain(reactionText(aDrill().ready))).toBe("Force or Load cell within 1 ms");
    expect(plain(reactionText(aDrill().test))).toBe("Nothing trips for 3 s");
    expect(reactionText(null)).toBe("Cannot be given then");
    expect(plain(announcement(aDrill(), 1, "ready"))).toBe(
      "“Load cell open” (1) goes into the simulated rig at once. The rig must trip: Force or Load cell within 1 ms.",
    );
    expect(announcement(aDrill({ low: 1 }), 1, "running")).toBe(
      "“Load cell open” goes into the simulated rig at once. The load must stay on.",
    );
  });

  it("counts ticks and time", () => {
    const score = { first_out: "force", action: "shutdown", reaction_ticks: 1, safe_ticks: 1, mode_after: "tripped" };
    const figures = reactionFigures({ period_s: 1 / 4000, score: { ...score, peaks: [], expectations: [] } });
    expect(figures.map(([, text]) => plain(text))).toEqual(["1 tick, 0.25 ms", "1 tick, 0.25 ms", "Force", "tripped"]);
    expect([0.06, 3, 20].map((time_s) => plain(timeText(time_s)))).toEqual(["60 ms", "3 s", "20 s"]);
  });

  it("tallies what was scored and nothing else", () => {
    const records = ["passed", "failed", "passed", "interrupted", "under_way"].map((state) => ({ state }) as DrillSummary);
    expect(tally(records)).toBe("2 of 3 passed");
    expect(tally([])).toBe("");
  });
});
