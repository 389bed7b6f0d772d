// The waveform of a draft: asked for anew while one types, the latest wins, the one before stays until then.

import { textOf } from "../messages.svelte";
import type { Sound } from "./editor.svelte";
import { Latest } from "./latest";
import { previewTest, type PreviewWindow } from "./requests";
import type { Preview } from "./types";

const PAUSE_MS = 80;

export class Previews {
  shown = $state.raw<Preview | null>(null);
  /** What `shown` was made of. */
  of = $state.raw<Sound | null>(null);
  busy = $state(false);
  failure = $state("");
  private readonly questions = new Latest();

  ask(sound: Sound, part: PreviewWindow): void {
    this.busy = true;
    this.questions.ask(PAUSE_MS, async (signal) => {
      try {
        const shown = await previewTest({ yaml: sound.yaml }, part, signal);
        if (signal.aborted) return;
        this.shown = shown;
        this.of = sound;
        this.failure = "";
      } catch (error) {
        if (signal.aborted) return;
        this.failure = textOf(error);
      }
      this.busy = false;
    });
  }

  close(): void {
    this.questions.cancel();
  }
}
