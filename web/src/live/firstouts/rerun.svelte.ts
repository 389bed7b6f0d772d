// A re-run under way: asked for again until it is there. Latest wins.

import type { Overlay } from "../../charts/overlays";
import { textOf } from "../messages.svelte";
import { Latest } from "../tests/latest";
import type { Json } from "../tests/tree";
import type { Computing } from "../types";
import { rerunFirstOut } from "./requests";
import type { Course, Rerun } from "./types";

const WAIT_S = 1;
const POINTS = 20_000; // every tick of the four seconds
/** The channel of each chart that is laid over what was recorded. */
const CHANNEL_OF: Readonly<Record<string, string>> = {
  force: "force_n",
  displacement: "displacement_m",
  velocity: "velocity_m_s",
  valve: "valve_command",
  pressures: "supply_pressure_pa",
  error: "force_error_n",
};
const CHANNELS = Object.values(CHANNEL_OF);

export class RerunJob {
  result = $state.raw<Rerun | null>(null);
  computing = $state.raw<Computing | null>(null);
  busy = $state(false);
  failure = $state("");
  private readonly asks = new Latest();

  constructor(private readonly id: number) {}

  start(path: string, value: Json): void {
    this.busy = true;
    this.computing = null;
    this.failure = "";
    void this.asks.now((signal) => this.follow(path, value, signal));
  }

  cancel(): void {
    this.asks.cancel();
    this.busy = false;
    this.computing = null;
  }

  private async follow(path: string, value: Json, signal: AbortSignal): Promise<void> {
    try {
      const asked = { change: { path, value }, channels: CHANNELS, points: POINTS, wait_s: WAIT_S };
      for (;;) {
        const until = AbortSignal.any([signal, AbortSignal.timeout(60_000)]);
        const answer = await rerunFirstOut(this.id, asked, until);
        if (signal.aborted) return;
        if ("text" in answer) {
          this.result = answer;
          break;
        }
        this.computing = answer;
      }
    } catch (error) {
      if (signal.aborted) return;
      this.failure = textOf(error);
    }
    this.busy = false;
    this.computing = null;
  }
}

/** What to lay over each chart: the virtual rig as it was, and with the change. */
export function overlaysOf({ unchanged, changed }: Rerun): Readonly<Record<string, readonly Overlay[]>> {
  const courses = [
    { course: unchanged, label: "Virtual, unchanged", colour: "--stale", dashed: true },
    { course: changed, label: "Virtual, changed", colour: "--error", dashed: false },
  ];
  const ofChart = (channel: string): Overlay[] =>
    courses.flatMap(({ course, ...look }) => {
      const trace = traceOf(course, channel);
      return trace === null ? [] : [{ trace, ...look }];
    });
  return Object.fromEntries(Object.entries(CHANNEL_OF).map(([chart, channel]) => [chart, ofChart(channel)]));
}

function traceOf({ samples }: Course, channel: string): Overlay["trace"] | null {
  const band = samples?.channels[channel];
  return samples && band ? { time_s: samples.time_s, min: band.min, max: band.max } : null;
}
