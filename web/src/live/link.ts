// The WebSocket with its reconnecting, without any idea of what the frames mean for the screen.

import { decodeFrame, FrameError, type SampleFrame } from "./frame";
import type { ServerMessage } from "./types";

export interface LinkEvents {
  opened(): void;
  closed(): void;
  message(message: ServerMessage): void;
  samples(frame: SampleFrame): void;
  /** A frame that could not be understood: shown, never swallowed. */
  unreadable(detail: string): void;
}

type Timers = { set(run: () => void, delay_ms: number): number; clear(id: number): void };

const RETRY_MS = [250, 500, 1000, 2000, 4000] as const;
/** A server that accepts the connection and then says nothing is given up after this time. */
const SILENCE_MS = 5000;
const BROWSER_TIMERS: Timers = {
  set: (run, ms) => window.setTimeout(run, ms),
  clear: (id) => window.clearTimeout(id),
};

export class Link {
  private socket: WebSocket | null = null;
  private attempt = 0;
  private subscription = 0;
  private retry: number | null = null;
  private silence: number | null = null;
  private ended = false;

  constructor(
    private readonly url: string,
    private readonly events: LinkEvents,
    private readonly open: (url: string) => WebSocket = (address) => new WebSocket(address),
    private readonly timers: Timers = BROWSER_TIMERS,
  ) {}

  connect(): void {
    if (this.socket || this.ended) return;
    this.cancelRetry();
    const socket = this.open(this.url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.watchSilence();
    socket.onopen = () => this.events.opened();
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      this.attempt = 0;
      this.watchSilence();
      this.receive(data);
    };
    socket.onclose = () => this.lose(socket);
  }

  /** Asks for the samples of these channels in place of what was asked before. */
  subscribe(channels: readonly string[]): void {
    this.subscription += 1;
    this.socket?.send(JSON.stringify({ type: "subscribe", subscription: this.subscription, channels }));
  }

  /** A sign that whoever is in command is still there. */
  beat(epoch: number): void {
    this.socket?.send(JSON.stringify({ type: "beat", epoch }));
  }

  /** Tries at once, for instance because the network came back. */
  hurry(): void {
    if (!this.socket) this.connect();
  }

  end(): void {
    this.ended = true;
    this.cancelRetry();
    this.socket?.close();
    if (this.socket) this.lose(this.socket);
  }

  private receive(data: string | ArrayBuffer): void {
    try {
      if (typeof data === "string") return this.events.message(JSON.parse(data) as ServerMessage);
      const frame = decodeFrame(data);
      if (frame.subscription === this.subscription) this.events.samples(frame);
    } catch (error) {
      if (!(error instanceof FrameError || error instanceof SyntaxError)) throw error;
      this.events.unreadable(error.message);
    }
  }

  private lose(socket: WebSocket): void {
    if (this.socket !== socket) return;
    socket.onopen = socket.onmessage = socket.onclose = null;
    this.socket = null;
    if (this.silence !== null) this.timers.clear(this.silence);
    this.events.closed();
    if (this.ended) return;
    const delay = RETRY_MS[Math.min(this.attempt, RETRY_MS.length - 1)]!;
    this.attempt += 1;
    this.retry = this.timers.set(() => this.connect(), delay);
  }

  private watchSilence(): void {
    if (this.silence !== null) this.timers.clear(this.silence);
    const socket = this.socket;
    this.silence = this.timers.set(() => {
      if (!socket || this.socket !== socket) return;
      socket.close();
      this.lose(socket); // a dead peer never answers the closing handshake
    }, SILENCE_MS);
  }

  private cancelRetry(): void {
    if (this.retry !== null) this.timers.clear(this.retry);
    this.retry = null;
  }
}
