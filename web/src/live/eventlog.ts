// The log of events, bounded. What repeats is counted on one line, so that it cannot push out what matters.

import type { RigEvent } from "./types";

export interface LoggedEvent extends RigEvent {
  readonly serial: number;
  /** How often in a row this was reported; the time and text are of the last time. */
  readonly times: number;
}

/** Newest first. */
export type EventLog = readonly LoggedEvent[];

export const EVENTS_KEPT = 200;
const COUNTED: ReadonlySet<string> = new Set(["deadlines_missed", "skipped"]);

/** What another event tells already, with what came of it: that the console had the loop skip. */
const isTold = ({ kind, code }: RigEvent): boolean => kind === "command" && code === "skip";

/** Adds an event on top. A full log loses its oldest line that is no trip. */
export function logged(log: EventLog, event: RigEvent): EventLog {
  if (isTold(event)) return log;
  const same = sameAs(log, event);
  if (same !== undefined) {
    return [{ ...event, serial: same.serial, times: same.times + 1 }, ...log.filter((line) => line !== same)];
  }
  const line: LoggedEvent = { ...event, serial: log.reduce((most, { serial }) => Math.max(most, serial), 0) + 1, times: 1 };
  return [line, ...(log.length < EVENTS_KEPT ? log : withoutOldest(log))];
}

/** The line that an event is counted on: no other than lines of what is counted may be above it. */
function sameAs(log: EventLog, { kind }: RigEvent): LoggedEvent | undefined {
  if (!COUNTED.has(kind)) return undefined;
  const end = log.findIndex((line) => !COUNTED.has(line.kind));
  return log.slice(0, end < 0 ? log.length : end).find((line) => line.kind === kind);
}

function withoutOldest(log: EventLog): EventLog {
  const oldest = log.findLastIndex((event) => event.kind !== "trip");
  return oldest < 0 ? log.slice(0, -1) : log.toSpliced(oldest, 1);
}

/** Events of a run, oldest first, in the same way. */
export const inOrder = (events: readonly RigEvent[]): EventLog =>
  events.reduce<EventLog>((log, event) => logged(log, event), []).toReversed();
