// How many times as large as they are deformation and travel are drawn: a choice of a person, kept in this browser.

import type { Enlarged } from "./types";

const KEY = "forcerig.scene-enlarged";
export const MOST: Enlarged = { deformation: 100, travel: 3 };
const USUAL: Enlarged = { deformation: 50, travel: 1 };

class Enlarging {
  now = $state.raw<Enlarged>(kept());

  set(change: Partial<Enlarged>): void {
    this.now = { ...this.now, ...change };
    localStorage.setItem(KEY, JSON.stringify(this.now));
  }
}

/** What was chosen last; the usual where nothing that makes sense is kept. */
function kept(): Enlarged {
  try {
    const found = JSON.parse(localStorage.getItem(KEY) ?? "{}") as Partial<Enlarged>;
    const times = (name: keyof Enlarged): number =>
      typeof found[name] === "number" && found[name] >= 1 && found[name] <= MOST[name] ? found[name] : USUAL[name];
    return { deformation: times("deformation"), travel: times("travel") };
  } catch {
    return USUAL;
  }
}

export const enlarging = new Enlarging();
