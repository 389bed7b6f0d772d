// What the pages know of the rig. Only what changes ten times a second or slower is reactive; samples are not.

import { session } from "./access/session.svelte";
import { authority } from "./authority/authority.svelte";
import { logged, type EventLog } from "./eventlog";
import { judge, sentence, type Freshness, type Signs } from "./freshness";
import { Link } from "./link";
import { Misses } from "./misses";
import { tellPoint } from "./responses/points";
import { prepare, recentSpan, take, type Span } from "./samples";
import type { Hello, RigStatus, ServerMessage } from "./types";

const JUDGE_EVERY_MS = 100;
const SPANS = ["force_n", "displacement_m", "velocity_m_s", "valve_command"] as const;
const SPAN_S = 1;

const now_s = (): number => performance.now() / 1000;

class Rig {
  status = $state.raw<RigStatus | null>(null);
  hello = $state.raw<Hello | null>(null);
  events = $state.raw<EventLog>([]);
  /** Extremes of the last second, for the meters. */
  spans = $state.raw<Readonly<Record<string, Span>>>({});
  fresh = $state.raw<Freshness>({ stale: true, trouble: "connecting", age_s: null });
  /** Why the last frame that could not be read could not; empty while all could. */
  unreadable = $state("");
  /** The loop missed deadlines within the last minute. */
  missedLately = $state(false);
  /** Goes up each time the list of runs has changed. */
  runsVersion = $state(0);

  readonly trouble = $derived(sentence(this.fresh));

  private signs: Signs = {
    socketOpen: false,
    statusAt_s: null,
    samplesAt_s: null,
    loopAlive: null,
    loopAge_s: null,
    loopStarting: false,
  };
  private readonly misses = new Misses();
  private link: Link | null = null;

  /** Connects, and keeps connecting. @returns a function that ends it. */
  connect(): () => void {
    const { protocol, host } = window.location;
    const link = new Link(`${protocol === "https:" ? "wss" : "ws"}://${host}/api/v1/live`, {
      opened: () => this.note({ socketOpen: true }),
      closed: () => this.lose(),
      message: (message) => this.receive(message),
      samples: (frame) => {
        take(frame);
        this.signs = { ...this.signs, samplesAt_s: now_s() };
      },
      unreadable: (detail) => (this.unreadable = detail),
    });
    this.link = link;
    link.connect();
    const timer = window.setInterval(() => this.judge(), JUDGE_EVERY_MS);
    const hurry = (): void => link.hurry();
    window.addEventListener("online", hurry);
    return () => {
      window.clearInterval(timer);
      window.removeEventListener("online", hurry);
      link.end();
    };
  }

  /** A link that was closed by the server looks like one that broke: whether somebody is signed in is asked. */
  private lose(): void {
    this.note({ socketOpen: false });
    if (session.isIn) void session.ask();
  }

  private receive(message: ServerMessage): void {
    if (message.type === "status") this.takeStatus(message.status);
    else if (message.type === "hello") this.takeHello(message);
    else if (message.type === "event") this.events = logged(this.events, message.event);
    else if (message.type === "runs") this.runsVersion += 1;
    else if (message.type === "response") tellPoint(message);
    else if (message.type === "error") this.unreadable = message.detail;
  }

  private takeHello(hello: Hello): void {
    this.hello = hello;
    this.link?.subscribe(prepare(hello));
    this.runsVersion += 1; // what changed while nobody listened is not known
    this.note({ samplesAt_s: now_s() });
  }

  private takeStatus(status: RigStatus): void {
    this.status = status;
    this.missedLately = this.misses.lately(status.loop.deadlines_missed, now_s());
    const epoch = authority.follow(status.lease, now_s());
    if (epoch !== null) this.link?.beat(epoch);
    this.spans = Object.fromEntries(SPANS.map((channel) => [channel, recentSpan(channel, SPAN_S)]));
    this.note({
      statusAt_s: now_s(),
      loopAlive: status.loop.alive,
      loopAge_s: status.loop.data_age_s,
      loopStarting: status.mode === "starting",
    });
  }

  private note(signs: Partial<Signs>): void {
    this.signs = { ...this.signs, ...signs };
    this.judge();
  }

  private judge(): void {
    const next = judge(this.signs, now_s());
    const { stale, trouble, age_s } = this.fresh;
    const sameAge = tenths(next.age_s) === tenths(age_s);
    if (next.stale !== stale || next.trouble !== trouble || !sameAge) this.fresh = next;
  }
}

/** Age in tenths of a second, rounded up: what the screen shows. */
function tenths(age_s: number | null): number | null {
  return age_s === null ? null : Math.ceil(age_s * 10);
}

export const rig = new Rig();
