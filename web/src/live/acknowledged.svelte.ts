// Which trips a person has seen. Seen in this window only: the latch itself is cleared by Reset.

import { rig } from "./rig.svelte";
import type { Trip } from "./types";

const identity = (trip: Trip): string => `${trip.code}@${trip.tick}`;

class Acknowledged {
  private seen = $state.raw<ReadonlySet<string>>(new Set());

  /** Whether a trip is on the screen that nobody has acknowledged. */
  readonly waiting = $derived((rig.status?.trips ?? []).some((trip) => !this.seen.has(identity(trip))));

  all(): void {
    this.seen = new Set((rig.status?.trips ?? []).map(identity));
  }
}

export const acknowledged = new Acknowledged();
