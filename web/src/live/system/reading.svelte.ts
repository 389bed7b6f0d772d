// Something that is read from the server, shown as last read, and read again on demand.

import { textOf } from "../messages.svelte";

export class Reading<T> {
  value = $state.raw<T | null>(null);
  failure = $state("");
  busy = $state(false);
  private serial = 0;

  constructor(private readonly ask: () => Promise<T>) {}

  /** Reads it again; of several readings the newest counts. */
  async read(): Promise<void> {
    const serial = ++this.serial;
    this.busy = true;
    try {
      const value = await this.ask();
      if (serial !== this.serial) return;
      this.value = value;
      this.failure = "";
    } catch (error) {
      if (serial !== this.serial) return;
      this.failure = textOf(error);
    }
    this.busy = false;
  }

  /** Does something, says what went wrong, and reads again. @returns whether it was done */
  async after(act: () => Promise<unknown>): Promise<boolean> {
    try {
      await act();
    } catch (error) {
      this.failure = textOf(error);
      return false;
    }
    await this.read();
    return true;
  }
}
