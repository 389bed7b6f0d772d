// Drills in words. Pure.

import { quantityOfUnit, spoken } from "../../quantities";
import { PLAIN, toEntry, type Quantity } from "../../units";
import type { Drill, DrillDetail, DrillSummary, Reaction } from "./types";

export const STATES: Readonly<Record<string, string>> = {
  under_way: "Under way",
  passed: "Passed",
  failed: "Failed",
  interrupted: "Interrupted",
};

/** The quantity in which an amount is typed; a share or a factor has no unit. */
export function amountQuantity({ unit, high }: Pick<Drill, "unit" | "high">): Quantity {
  if (unit === "s" && high < 1) return { label: "", symbol: "ms", scale: 1e3, digits: 1 };
  return unit === "-" || unit === "" ? PLAIN : quantityOfUnit(unit);
}

/** A fault that is either there or not has no amount to choose. */
export const hasAmount = ({ low, high }: Pick<Drill, "low" | "high">): boolean => low < high;

const named = (quantity: Quantity, si: number): string =>
  quantity.symbol === "" ? toEntry(quantity, si) : `${toEntry(quantity, si)}\u00a0${quantity.symbol}`;

/** `0.1 ms … 50 ms: how long …`. */
export function boundsText(drill: Drill): string {
  const quantity = amountQuantity(drill);
  return `${named(quantity, drill.low)} … ${named(quantity, drill.high)}, not 0: ${drill.amount}`;
}

export const amountText = (drill: Drill, amount: number): string =>
  hasAmount(drill) ? named(amountQuantity(drill), amount) : "";

/** Why an amount cannot be given; null where it can. */
export function amountRefusal(drill: Drill, amount: number | null): string | null {
  if (amount === null) return "A figure is needed";
  return amount < drill.low || amount > drill.high || amount === 0 ? `Choose ${boundsText(drill)}` : null;
}

/** What must follow, in one line: `First-out Force or Load cell within 1 ms`. */
export function reactionText(reaction: Reaction | null): string {
  if (reaction === null) return "Cannot be given then";
  if (reaction.first_outs.length === 0) return `Nothing trips for ${timeText(reaction.within_s)}`;
  const names = reaction.first_outs.map(spoken);
  const all = names.length === 1 ? names[0] : `${names.slice(0, -1).join(", ")} or ${names.at(-1)}`;
  return `${all} within ${timeText(reaction.within_s)}`;
}

/** `0.25 ms`, `60 ms`, `3 s`. */
export const timeText = (time_s: number): string =>
  time_s < 1 ? `${Number((1e3 * time_s).toPrecision(4))}\u00a0ms` : `${Number(time_s.toPrecision(4))}\u00a0s`;

/** What a press will do: `Inject “Load cell open” (1) now. The rig must trip on Force within 1 ms.` */
export function announcement(drill: Drill, amount: number, mode: string | null): string {
  const reaction = mode === "ready" ? drill.ready : drill.test;
  const much = hasAmount(drill) ? ` (${amountText(drill, amount)})` : "";
  const follows =
    reaction === null ? "" : reaction.first_outs.length === 0 ? " The load must stay on." : ` The rig must trip: ${reactionText(reaction)}.`;
  return `“${drill.name}”${much} goes into the simulated rig at once.${follows}`;
}

/** How long the rig took to know, and to be safe. */
export function reactionFigures({ score, period_s }: Pick<DrillDetail, "score" | "period_s">): readonly (readonly [string, string])[] {
  if (score === null) return [];
  const figure = (ticks: number | null): string =>
    ticks === null ? "—" : `${ticks} ${ticks === 1 ? "tick" : "ticks"}, ${timeText(ticks * period_s)}`;
  return [
    ["Knew after", figure(score.reaction_ticks)],
    ["Safe after", figure(score.safe_ticks)],
    ["First-out", score.first_out === null ? "none" : spoken(score.first_out)],
    ["Ended", score.mode_after],
  ];
}

/** How many of the listed drills passed: `12 of 14 passed`. */
export function tally(records: readonly DrillSummary[]): string {
  const scored = records.filter(({ state }) => state === "passed" || state === "failed");
  return scored.length === 0 ? "" : `${scored.filter(({ state }) => state === "passed").length} of ${scored.length} passed`;
}
