// Points of frequency responses as the live stream brings them, for whoever shows them.

import type { ResponseFrame } from "./types";

type Listener = (frame: ResponseFrame) => void;
const listeners = new Set<Listener>();

/** Calls back with each point. @returns a function that ends it. */
export function onPoint(listener: Listener): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

export function tellPoint(frame: ResponseFrame): void {
  for (const listener of listeners) listener(frame);
}
