// Refusals and failures, shown beside the work and never in front of it. Bounded; a person dismisses them.

const KEPT = 4;

export interface Message {
  readonly id: number;
  readonly text: string;
  readonly topic: string;
}

class Messages {
  list = $state.raw<readonly Message[]>([]);
  private id = 0;

  /** Shows a message; an older one on the same topic gives way to it. */
  show(topic: string, text: string): void {
    this.id += 1;
    const others = this.list.filter((message) => message.topic !== topic);
    this.list = [{ id: this.id, text, topic }, ...others].slice(0, KEPT);
  }

  dismiss(id: number): void {
    this.list = this.list.filter((message) => message.id !== id);
  }

  clear(topic: string): void {
    this.list = this.list.filter((message) => message.topic !== topic);
  }
}

export const messages = new Messages();

/** The sentence of whatever was thrown. */
export function textOf(error: unknown): string {
  return error instanceof Error && error.message !== ""
    ? error.message
    : "Something went wrong in this page.";
}
