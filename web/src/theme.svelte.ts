// Light, dark, or as the machine says. The choice is kept in this browser.

export const THEMES = ["auto", "light", "dark"] as const;
export type ThemeChoice = (typeof THEMES)[number];

const KEY = "forcerig.theme";
const DARK = "(prefers-color-scheme: dark)";

class Theme {
  choice = $state<ThemeChoice>("auto");
  /** What is shown. */
  shown = $state<"light" | "dark">("light");
  private readonly listeners = new Set<() => void>();

  /** Reads the choice and follows the machine's. Called once, before anything is drawn. */
  start(): void {
    const kept = localStorage.getItem(KEY);
    this.choice = THEMES.find((theme) => theme === kept) ?? "auto";
    window.matchMedia(DARK).addEventListener("change", () => this.apply());
    this.apply();
  }

  next(): void {
    this.choice = THEMES[(THEMES.indexOf(this.choice) + 1) % THEMES.length]!;
    localStorage.setItem(KEY, this.choice);
    this.apply();
  }

  /** Calls back after each change, for what CSS cannot reach (canvas). @returns a function that ends it. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private apply(): void {
    const dark = this.choice === "auto" ? window.matchMedia(DARK).matches : this.choice === "dark";
    this.shown = dark ? "dark" : "light";
    document.documentElement.dataset.theme = this.shown;
    for (const listener of this.listeners) listener();
  }
}

export const theme = new Theme();
