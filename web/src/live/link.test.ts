import { describe, expect, it, vi } from "vitest";
import { Link, type LinkEvents } from "./link";

class FakeSocket {
  binaryType = "";
  sent: string[] = [];
  closed = false;
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  send(text: string): void {
    this.sent.push(text);
  }
  close(): void {
    this.closed = true;
  }
}

function bench() {
  const sockets: FakeSocket[] = [];
  let pending: { id: number; run: () => void; delay_ms: number }[] = [];
  let ids = 0;
  const events = {
    opened: vi.fn(),
    closed: vi.fn(),
    message: vi.fn(),
    samples: vi.fn(),
    unreadable: vi.fn(),
  } satisfies LinkEvents;
  const open = (): WebSocket => {
    sockets.push(new FakeSocket());
    return sockets.at(-1)! as unknown as WebSocket;
  };
  const timers = {
    set: (run: () => void, delay_ms: number) => {
      pending.push({ id: ++ids, run, delay_ms });
      return ids;
    },
    clear: (id: number) => {
      pending = pending.filter((timer) => timer.id !== id);
    },
  };
  const link = new Link("ws://rig/live", events, open, timers);
  return {
    link,
    events,
    sockets,
    newest: () => sockets.at(-1)!,
    delays: () => pending.map((timer) => timer.delay_ms),
    fire: () => {
      const [timer] = pending.splice(0, 1);
      timer!.run();
    },
  };
}

function sampleFrame(subscription: number): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(24 + 8));
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setUint16(2, 2, true);
  view.setUint32(4, 1, true);
  view.setUint32(20, subscription, true);
  return view.buffer as ArrayBuffer;
}

describe("Link", () => {
  it("numbers its subscriptions", () => {
    const { link, newest } = bench();
    link.connect();
    newest().onopen!();
    link.subscribe(["force_n", "valve_command"]);
    expect(JSON.parse(newest().sent[0]!)).toEqual({
      type: "subscribe",
      subscription: 1,
      channels: ["force_n", "valve_command"],
    });
  });

  it("sends beats of whoever is in command", () => {
    const { link, newest } = bench();
    link.connect();
    link.beat(7);
    expect(JSON.parse(newest().sent[0]!)).toEqual({ type: "beat", epoch: 7 });
  });

  it("tries again with growing pauses, and starts small again after a success", () => {
    const { link, newest, delays, fire, events } = bench();
    link.connect();
    const pauses: number[] = [];
    for (let i = 0; i < 6; i += 1) {
      newest().onclose!();
      pauses.push(...delays());
      fire();
    }
    expect(pauses).toEqual([250, 500, 1000, 2000, 4000, 4000]);
    expect(events.closed).toHaveBeenCalledTimes(6);
    newest().onopen!();
    newest().onmessage!({ data: '{"type":"runs"}' });
    newest().onclose!();
    expect(delays()).toEqual([250]);
  });

  it("drops samples that answer an older subscription: their columns mean something else", () => {
    const { link, newest, events, fire } = bench();
    link.connect();
    newest().onopen!();
    link.subscribe(["force_n"]);
    newest().onclose!();
    fire();
    newest().onopen!();
    link.subscribe(["force_n", "valve_command"]);
    newest().onmessage!({ data: sampleFrame(1) });
    expect(events.samples).not.toHaveBeenCalled();
    newest().onmessage!({ data: sampleFrame(2) });
    expect(events.samples).toHaveBeenCalledOnce();
  });

  it("gives up a connection that is open but silent", () => {
    const { link, newest, events, fire, delays } = bench();
    link.connect();
    newest().onopen!();
    const silent = newest();
    fire();
    expect(silent.closed).toBe(true);
    expect(events.closed).toHaveBeenCalledOnce();
    expect(delays()).toEqual([250]);
  });

  it("reports frames that it cannot read", () => {
    const { link, newest, events } = bench();
    link.connect();
    newest().onopen!();
    newest().onmessage!({ data: "not json" });
    newest().onmessage!({ data: new ArrayBuffer(3) });
    expect(events.unreadable).toHaveBeenCalledTimes(2);
  });

  it("stays closed once ended", () => {
    const { link, newest, delays, sockets } = bench();
    link.connect();
    newest().onopen!();
    link.end();
    link.hurry();
    expect(delays()).toEqual([]);
    expect(sockets).toHaveLength(1);
  });
});
