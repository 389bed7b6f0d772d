// Which commands there are, why one cannot be given now, and which is the sensible next one. Pure.

import type { Freshness } from "./freshness";
import type { StartGate } from "./predicting";
import type { Command, Mode, Permissive, RigStatus, TestSummary } from "./types";

export interface CommandInfo {
  readonly command: Command;
  readonly label: string;
  readonly key: string;
}

/** In the order in which a session goes. Stop is apart: it has its own control and its own key. */
export const COMMANDS: readonly CommandInfo[] = [
  { command: "reset", label: "Reset", key: "r" },
  { command: "pressurise", label: "Pressurise", key: "p" },
  { command: "tare", label: "Tare", key: "z" },
  { command: "start", label: "Start", key: "s" },
  { command: "hold", label: "Hold", key: "h" },
  { command: "resume", label: "Resume", key: "u" },
  { command: "depressurise", label: "Depressurise", key: "d" },
];

const NO_DATA: Record<NonNullable<Freshness["trouble"]>, string> = {
  connecting: "No link to the server yet",
  link: "No link to the server",
  starting: "The loop process is starting",
  loop: "The loop process is lost",
  samples: "No samples arrive",
};

/** What Start will run, whether its prediction allows it, and whether this person may command at all. */
export interface Intent {
  readonly chosen: TestSummary | null;
  readonly gate: StartGate;
  /** Why no command that needs command can be given from here; null where it can. */
  readonly notInCommand: string | null;
}

/** Why a command cannot be given now; null where it can. Stop can always be given. */
export function refusal(
  command: Command,
  status: RigStatus | null,
  fresh: Freshness,
  { chosen, gate, notInCommand }: Intent,
): string | null {
  if (command === "stop") return null;
  if (fresh.trouble !== null) return NO_DATA[fresh.trouble];
  const reason = status?.commands[command];
  if (reason === undefined) return "Not offered by this server";
  if (reason !== null) return reason;
  if (notInCommand !== null) return notInCommand;
  if (command !== "start") return null;
  if (chosen === null) return "Choose a test first";
  return gate.is === "closed" ? gate.why : null;
}

const NEXT: Partial<Record<Mode, Command>> = {
  tripped: "reset",
  off: "pressurise",
  ready: "start",
  holding: "resume",
};

/** The command that takes the rig one step further, if it can be given now. */
export function nextCommand(
  status: RigStatus | null,
  fresh: Freshness,
  intent: Intent,
): Command | null {
  const next = status === null ? undefined : NEXT[status.mode];
  return next !== undefined && refusal(next, status, fresh, intent) === null ? next : null;
}

/** One line that tells a person at the rig what to do now. */
export function guidance(status: RigStatus | null, fresh: Freshness, intent: Intent): string {
  if (status === null || fresh.stale) return "Commands wait until data arrive again. Stop is always sent.";
  const next = nextCommand(status, fresh, intent);
  if (next === "start" && intent.gate.is === "reason") return CAUTION;
  if (next !== null) return SENTENCES[next] ?? "";
  const wanted = NEXT[status.mode];
  if (wanted !== undefined) return refusal(wanted, status, fresh, intent) ?? "";
  return WAITING[status.mode] ?? "";
}

const CAUTION = "The prediction warns. Press Start to give a reason and run all the same.";
const SENTENCES: Partial<Record<Command, string>> = {
  reset: "Press Reset to clear the latch. Reset starts nothing.",
  pressurise: "Press Pressurise to bring up the supply.",
  start: "Press Start to run this test.",
  resume: "Held. Press Resume to go on, or Stop to end the run.",
};
const WAITING: Partial<Record<Mode, string>> = {
  pressurising: "The supply pressure is rising.",
  stopping: "Stopping: the load is brought down.",
};

/** What a start still needs, in the rig's own words; nothing while no data arrive. */
export function missing(status: RigStatus | null, fresh: Freshness): readonly Permissive[] {
  if (status === null || fresh.trouble !== null || status.run !== null) return [];
  return status.permissives.filter(({ met }) => !met);
}
