// The live samples: plain typed arrays outside of Svelte's reactive state. Charts look here once a frame.

import type { ChannelName } from "../gen/channels";
import type { SampleFrame } from "./frame";
import { SampleRing } from "./ring";
import type { Hello } from "./types";

export const WINDOW_S = 60;

export const LIVE_CHANNELS = [
  "force_n",
  "force_command_n",
  "force_error_n",
  "displacement_m",
  "displacement_command_m",
  "velocity_m_s",
  "valve_command",
  "spool_position",
] as const satisfies readonly ChannelName[];

export interface LiveSamples {
  ring: SampleRing;
  period_s: number;
}

let current: LiveSamples = { ring: new SampleRing([], 1), period_s: 1 };

/** The window being filled now. Ask anew each frame: another loop may bring another rate. */
export const live = (): LiveSamples => current;

/** Makes room for what the server offers and returns the channels to subscribe to. What is already there stays. */
export function prepare({ period_s, channels }: Hello): string[] {
  const offered = new Set(channels.map((channel) => channel.name));
  const wanted = LIVE_CHANNELS.filter((name) => offered.has(name));
  const { ring } = current;
  if (current.period_s !== period_s || wanted.join() !== ring.channels.join()) {
    const next = new SampleRing(wanted, Math.round(WINDOW_S / period_s));
    next.received = ring.received;
    next.generation = ring.generation + 1;
    current = { ring: next, period_s };
  }
  return wanted;
}

export function take(frame: SampleFrame): void {
  current.ring.push(frame.firstTick, frame.columns);
}

export interface Span {
  low: number;
  high: number;
}

/** Lowest and highest value of a channel over the last `seconds`; NaN where there is none. */
export function recentSpan(channel: string, seconds: number): Span {
  const { ring, period_s } = current;
  const column = ring.column(channel);
  const span = { low: Infinity, high: -Infinity };
  const from = Math.max(ring.firstTick, ring.endTick - Math.round(seconds / period_s));
  for (let tick = from; column && tick < ring.endTick; tick += 1) {
    const value = column[tick % ring.capacity]!;
    if (value < span.low) span.low = value;
    if (value > span.high) span.high = value;
  }
  return span.low <= span.high ? span : { low: NaN, high: NaN };
}
