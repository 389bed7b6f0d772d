// Help while typing YAML.

/** The text after Enter between two places, and where the cursor then is: the new line begins where the old one did. */
export function continued(text: string, from: number, to: number): { text: string; at: number } {
  const lineStart = text.lastIndexOf("\n", from - 1) + 1;
  const line = text.slice(lineStart, from);
  const indent = /^ */.exec(line)![0];
  const deeper = /:\s*$/.test(line) ? "  " : "";
  const inserted = `\n${indent}${deeper}`;
  return { text: text.slice(0, from) + inserted + text.slice(to), at: from + inserted.length };
}
