// Giving commands. A refusal becomes a message; a Stop that was not delivered is said loudly.

import { Problem, sendCommand, startRun } from "./api";
import { authority } from "./authority/authority.svelte";
import { entry } from "./entry.svelte";
import { COMMANDS, refusal, type Intent } from "./operate";
import { messages, textOf } from "./messages.svelte";
import { predictor } from "./prediction.svelte";
import { rig } from "./rig.svelte";
import { deliver, stopWays } from "./stopping";
import { tests } from "./tests.svelte";
import type { Command } from "./types";

const TOPIC = "command";
const STOP_SHOWN_MS = 4000;

class Commands {
  /** The command whose answer is awaited. */
  pending = $state<Command | null>(null);
  /** What Start would run now, and whether it may. */
  readonly intent: Intent = $derived({
    chosen: tests.chosen,
    gate: predictor.gate,
    notInCommand: authority.notInCommand,
  });

  /** Gives a command if it can be given; otherwise says why not. */
  async give(command: Exclude<Command, "stop">): Promise<void> {
    if (this.pending !== null) return;
    const label = COMMANDS.find((info) => info.command === command)?.label ?? command;
    const reason = refusal(command, rig.status, rig.fresh, this.intent);
    if (reason !== null) return messages.show(TOPIC, `${label} cannot be given now. ${reason}.`);
    const overriding = command === "start" && this.intent.gate.is === "reason";
    if (overriding && !(entry.asking && entry.hasReason)) return void (entry.asking = true);
    this.pending = command;
    try {
      if (command === "start") await this.start(overriding);
      else await sendCommand(command, authority.epoch);
      messages.clear(TOPIC);
    } catch (error) {
      const what = error instanceof Problem && error.status !== null ? "was refused" : "was not delivered";
      messages.show(TOPIC, `${label} ${what}. ${textOf(error)}`);
    } finally {
      this.pending = null;
    }
  }

  private async start(overriding: boolean): Promise<void> {
    const test = tests.chosen!;
    const lease = authority.epoch;
    await startRun(test.id, { revision: entry.revisionOf(test), lease, ...entry.body(overriding) });
    entry.started();
  }
}

type StopState = "idle" | "sending" | "taken" | "failed";

class Stop {
  state = $state<StopState>("idle");
  failure = $state("");
  private serial = 0;

  /** Sends Stop at once, whatever else goes on and whoever is in command. Never asks. */
  async press(): Promise<void> {
    const serial = ++this.serial;
    this.state = "sending";
    const error = await deliver(stopWays(rig.status?.stop_url ?? null));
    if (serial !== this.serial) return;
    this.state = error === null ? "taken" : "failed";
    this.failure = error === null ? "" : textOf(error);
    if (error === null)
      window.setTimeout(() => {
        if (serial === this.serial) this.state = "idle";
      }, STOP_SHOWN_MS);
  }

  dismiss(): void {
    this.serial += 1;
    this.state = "idle";
    this.failure = "";
  }
}

export const commands = new Commands();
export const stop = new Stop();
