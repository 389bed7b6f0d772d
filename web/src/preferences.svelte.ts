// Small choices of a person, kept in this browser.

const SINGLE_KEYS = "forcerig.single-keys";

class Preferences {
  singleKeys = $state(true);

  start(): void {
    this.singleKeys = localStorage.getItem(SINGLE_KEYS) !== "off";
  }

  setSingleKeys(on: boolean): void {
    this.singleKeys = on;
    localStorage.setItem(SINGLE_KEYS, on ? "on" : "off");
  }
}

export const preferences = new Preferences();
