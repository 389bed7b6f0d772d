// Stop goes two ways at once: through the interface, and by a path of its own that works while the interface does not.

import { Problem, sendCommand } from "./api";

export type Way = () => Promise<unknown>;

const TRIES = 3;
const WAIT_MS = 1500;

/** Delivers by all ways at once; the first that arrives counts. @returns null, or why none did. */
export async function deliver(ways: readonly Way[]): Promise<unknown> {
  try {
    await Promise.any(ways.map((way) => persistently(way)));
    return null;
  } catch (error) {
    return error instanceof AggregateError ? error.errors[0] : error;
  }
}

/** Tries again where the network failed; not where it was understood and refused. */
async function persistently(way: Way): Promise<void> {
  for (let attempt = 1; ; attempt += 1) {
    try {
      await way();
      return;
    } catch (error) {
      const understood = error instanceof Problem && error.status !== null && error.status < 500;
      if (understood || attempt === TRIES) throw error;
    }
  }
}

/** The ways that there are. The first one's failure is what is told. */
export function stopWays(stopUrl: string | null): readonly Way[] {
  const options = (): RequestInit => ({ keepalive: true, signal: AbortSignal.timeout(WAIT_MS) });
  const own: Way = () => sendCommand("stop", undefined, options());
  if (stopUrl === null) return [own];
  const url = underName(stopUrl, window.location.hostname);
  return [own, () => byPathOfItsOwn(url, options())];
}

/** An address of the same machine under the name by which this page knows it: cookies go with the name. */
export function underName(url: string, name: string): string {
  const address = new URL(url);
  address.hostname = name;
  return address.href;
}

async function byPathOfItsOwn(url: string, options: RequestInit): Promise<void> {
  const response = await fetch(url, { ...options, method: "POST", credentials: "include" });
  if (!response.ok) throw new Problem(`Stop was refused (${response.status}).`, "stop_refused", response.status);
}
