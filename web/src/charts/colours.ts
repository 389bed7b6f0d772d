// The theme's colours for what is drawn on canvas, where CSS does not reach.

import { theme } from "../theme.svelte";

const known = new Map<string, string>();
theme.onChange(() => known.clear());

/** The present value of a CSS variable of the theme, such as `--measured`. */
export function colour(variable: string): string {
  let value = known.get(variable);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(variable).trim();
    known.set(variable, value);
  }
  return value;
}
