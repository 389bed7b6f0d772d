// Comments in YAML, which a form cannot keep. Text in quotes and in block scalars holds none.

/** The comments of a text, in order, each without its `#`. */
export function commentsIn(yaml: string): string[] {
  const found: string[] = [];
  let scalarIndent: number | null = null; // of the key whose block scalar we are in
  for (const line of yaml.split("\n")) {
    const indent = line.search(/\S/);
    if (scalarIndent !== null && (indent === -1 || indent > scalarIndent)) continue;
    scalarIndent = null;
    const at = commentStart(line);
    if (at !== -1) found.push(line.slice(at + 1).trim());
    const code = at === -1 ? line : line.slice(0, at);
    if (/(^|[:\-\s])[|>][+\-\d]*\s*$/.test(code)) scalarIndent = indent;
  }
  return found;
}

function commentStart(line: string): number {
  let quote = "";
  for (let i = 0; i < line.length; i += 1) {
    const char = line[i]!;
    if (quote !== "") {
      if (char === "\\" && quote === '"') i += 1;
      else if (char === quote && quote === "'" && line[i + 1] === "'") i += 1;
      else if (char === quote) quote = "";
    } else if ((char === '"' || char === "'") && /^$|[\s[{,:]/.test(line[i - 1] ?? "")) quote = char;
    else if (char === "#" && /^$|\s/.test(line[i - 1] ?? "")) return i;
  }
  return -1;
}
