// Identifications: the list, the one that is looked at, and what is asked of them. Looked at again while one is under way.

import type { components } from "../../gen/api";
import { post, request } from "../api";
import { textOf } from "../messages.svelte";

type Schemas = components["schemas"];
export type Summary = Schemas["IdentificationSummary"];
export type Identification = Schemas["IdentificationOut"];
export type Fitted = Schemas["FittedParameter"];

const LOOK_MS = 1000;
const AT = "identifications";
export const isUnderWay = ({ state }: Pick<Summary, "state">): boolean => state === "waiting" || state === "running";

export class Identifications {
  list = $state.raw<readonly Summary[] | null>(null);
  shown = $state.raw<Identification | null>(null);
  failure = $state("");
  busy = $state(false);
  private timer = 0;
  private ended = false;

  constructor() {
    void this.look();
  }

  start(run_ids: readonly number[]): Promise<boolean> {
    return this.attempt(() => request<Identification>(AT, post({ run_ids })));
  }
  cancel(id: number): Promise<boolean> {
    return this.attempt(() => request<Identification>(`${AT}/${id}/cancel`, post({})));
  }
  adopt(id: number, why: string, lease: number | undefined): Promise<boolean> {
    return this.attempt(() => request<Identification>(`${AT}/${id}/adopt`, post({ why, lease })));
  }
  remove(id: number): Promise<boolean> {
    return this.attempt(async () => {
      await request(`${AT}/${id}`, { method: "DELETE" });
      return null;
    });
  }
  show(id: number): Promise<boolean> {
    return this.attempt(() => request<Identification>(`${AT}/${id}`));
  }

  end(): void {
    this.ended = true;
    window.clearTimeout(this.timer);
  }

  /** @returns whether it was done; if so, what came back is shown. */
  private async attempt(what: () => Promise<Identification | null>): Promise<boolean> {
    this.busy = true;
    let done = false;
    try {
      this.shown = await what();
      this.failure = "";
      done = true;
    } catch (error) {
      this.failure = textOf(error);
    }
    this.busy = false;
    await this.look();
    return done;
  }

  private async look(): Promise<void> {
    window.clearTimeout(this.timer);
    try {
      const list = await request<Summary[]>(AT);
      const { shown } = this;
      const first = shown?.id ?? list[0]?.id;
      if (first !== undefined && (shown === null || isUnderWay(shown))) this.shown = await request<Identification>(`${AT}/${first}`);
      this.list = list;
    } catch (error) {
      this.failure = textOf(error);
    }
    if (!this.ended && this.list?.some(isUnderWay)) this.timer = window.setTimeout(() => void this.look(), LOOK_MS);
  }
}
