// One 3-D view of this page: what it shows, and what becomes of the process that draws it.

import { textOf } from "../messages.svelte";
import { Follower } from "./follow";
import { getScene, pointScene } from "./requests";
import type { Enlarged, Moment, Scene } from "./types";

const LOOK_MS = 1500;
const PAUSE_MS = 50;

interface Shown {
  readonly moment: Moment | null;
  readonly enlarged: Enlarged;
}

export class SceneView {
  /** Names this view among those of this session: nobody else can steer it. */
  readonly name = nameOf(crypto.getRandomValues(new Uint32Array(3)));
  scene = $state.raw<Scene | null>(null);
  /** Why what is wanted is not shown; empty where it is. */
  failure = $state("");
  private shown: Shown | null = null;
  private readonly follower = new Follower<Shown>((wanted) => this.tell(wanted), PAUSE_MS);

  /** Changes with each process that draws: the page of the one before shows nothing any more. */
  readonly life = $derived(this.scene?.state === "ready" ? this.scene.life : null);

  show(moment: Moment | null, enlarged: Enlarged): void {
    this.shown = { moment, enlarged };
    this.follower.follow(this.shown);
  }

  /** Begins to look what the process does. @returns a function that ends it. */
  start(): () => void {
    const timer = window.setInterval(() => void this.look(), LOOK_MS);
    return () => window.clearInterval(timer);
  }

  private async tell({ moment, enlarged }: Shown): Promise<void> {
    try {
      this.scene = await pointScene(this.name, moment, enlarged);
      this.failure = "";
    } catch (error) {
      this.failure = textOf(error);
    }
  }

  private async look(): Promise<void> {
    try {
      this.scene = await getScene();
      // a view that somebody has left open wants it again: to be told is to be wanted
      if (this.scene.state === "idle" && this.shown !== null && document.visibilityState === "visible") {
        this.follower.follow(this.shown);
      }
    } catch (error) {
      this.scene = null;
      this.failure = textOf(error);
    }
  }
}

const nameOf = (numbers: Uint32Array): string => [...numbers].map((number) => number.toString(36)).join("-");
