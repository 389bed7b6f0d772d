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
const COUNTED: ReadonlySet<string> = new Set(["deadlines_missed"]);

/** Adds an event on top. A full log loses its oldest line that is no trip. */
export function logged(log: EventLog, event: RigEvent): EventLog {
  const [newest] = log;
  if (newest && newest.kind === event.kind && newest.code === event.code && COUNTED.has(event.kind)) {
    return [{ ...event, serial: newest.serial, times: newest.times + 1 }, ...log.slice(1)];
  }
  const line: LoggedEvent = { ...event, serial: (newest?.serial ?? 0) + 1, times: 1 };
  return [line, ...(log.length < EVENTS_KEPT ? log : withoutOldest(log))];
}

function withoutOldest(log: EventLog): EventLog {
  const oldest = log.findLastIndex((event) => event.kind !== "trip");
  return oldest < 0 ? log.slice(0, -1) : log.toSpliced(oldest, 1);
}

/** Events of a run, oldest first, in the same way. */
export const inOrder = (events: readonly RigEvent[]): EventLog =>
  events.reduce<EventLog>((log, event) => logged(log, event), []).toReversed();
