// What the backend says, as docs/wire.md has it. The one module to change when the generated types take over.

export type Mode = "tripped" | "off" | "pressurising" | "ready" | "running" | "holding" | "stopping" | "lost";

/** Commands that go to `POST /api/v1/rig/commands`. */
export type RigCommand = "reset" | "pressurise" | "depressurise" | "hold" | "resume" | "stop" | "shutdown";
/** Everything that `status.commands` speaks of: starting a run is its own request. */
export type Command = RigCommand | "start";

export interface Trip {
  code: string;
  text: string;
  tick: number;
  first: boolean;
}

export interface Condition {
  name: string;
  had: boolean;
  reason: string;
}

export interface LoopHealth {
  alive: boolean;
  data_age_s: number | null;
  tick: number;
  rate_hz: number | null;
  pid: number | null;
  deadlines_missed: number;
  realtime: boolean;
  wakeup_latency_p50_s: number | null;
  wakeup_latency_p99_s: number | null;
  wakeup_latency_max_s: number | null;
  tick_time_p50_s: number | null;
  tick_time_p99_s: number | null;
  tick_time_max_s: number | null;
  conditions: Condition[];
}

export interface RunProgress {
  id: number;
  test_name: string;
  block: number;
  blocks: number;
  cycle: number;
  cycles: number | null;
  elapsed_s: number;
  duration_s: number | null;
}

export interface Recorder {
  recording: boolean;
  lost_ticks: number;
  bytes: number;
}

export interface RigStatus {
  mode: Mode;
  mode_since_s: number | null;
  readings: Record<string, number | null>;
  limits: Record<string, number | null>;
  trips: Trip[];
  loop: LoopHealth;
  run: RunProgress | null;
  recorder: Recorder | null;
  commands: Partial<Record<Command, string | null>>;
}

export interface RigEvent {
  tick: number;
  time_s: number;
  kind: string;
  code: string;
  text: string;
}

export interface ChannelInfo {
  name: string;
  unit: string;
  dtype: string;
  doc: string;
}

export interface Hello {
  type: "hello";
  period_s: number;
  version: string;
  channels: ChannelInfo[];
}

export type ServerMessage =
  | Hello
  | { type: "status"; status: RigStatus }
  | { type: "event"; event: RigEvent }
  | { type: "runs" }
  | { type: "error"; code: string; detail: string };

export interface TestSummary {
  id: number;
  name: string;
  description: string;
  duration_s: number | null;
  peak_force_n: number | null;
  blocks: number;
}

export interface Run {
  id: number;
  test_id: number | null;
  test_name: string;
  started_at: string;
  ended_at: string | null;
  outcome: string | null;
  verdict: string | null;
  ticks: number;
  missing_ticks: number;
  duration_s: number | null;
  reason: string | null;
}

export interface RunPage {
  runs: Run[];
  next: number | null;
}

export interface Band {
  min: (number | null)[];
  max: (number | null)[];
}

export interface RunSamples {
  from_s: number;
  to_s: number;
  decimated: boolean;
  time_s: number[];
  channels: Record<string, Band>;
}
