// A frozen document as YAML, to be read. Pure. Only what JSON can hold; never parsed again.

const PLAIN = /^[A-Za-zÀ-ÿ_][\w À-ÿ./()%°·-]*$/;
const WORDS = new Set(["true", "false", "null", "yes", "no", "on", "off", "~"]);
const INLINE = 90;

/** The lines of a value; a short list or mapping of plain values stands on one line. */
export function yamlOf(value: unknown): string {
  return `${block(value, "").replace(/^\n/, "")}\n`;
}

function block(value: unknown, indent: string): string {
  const short = inline(value);
  if (short !== null && short.length + indent.length <= INLINE) return short;
  if (Array.isArray(value)) return value.map((item) => `\n${indent}- ${nested(item, `${indent}  `)}`).join("");
  if (!isMapping(value)) return short ?? scalar(value);
  return Object.entries(value)
    .map(([key, inner]) => {
      const text = block(inner, `${indent}  `);
      return `\n${indent}${scalar(key)}:${text.startsWith("\n") ? text : ` ${text}`}`;
    })
    .join("");
}

/** Behind the dash of a list: the first line stands beside it. */
const nested = (value: unknown, indent: string): string => block(value, indent).replace(/^\n\s*/, "");

/** A mapping at the top or of mappings is never inline: `null` says so. */
function inline(value: unknown): string | null {
  if (Array.isArray(value)) {
    if (value.some((item) => typeof item === "object" && item !== null)) return value.length === 0 ? "[]" : null;
    return `[${value.map(scalar).join(", ")}]`;
  }
  if (!isMapping(value)) return scalar(value);
  const entries = Object.entries(value);
  if (entries.length === 0) return "{}";
  if (entries.some(([, inner]) => typeof inner === "object" && inner !== null)) return null;
  return `{${entries.map(([key, inner]) => `${scalar(key)}: ${scalar(inner)}`).join(", ")}}`;
}

const isMapping = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

function scalar(value: unknown): string {
  if (typeof value !== "string") return String(value);
  if (PLAIN.test(value) && !WORDS.has(value.toLowerCase()) && value === value.trim()) return value;
  return JSON.stringify(value);
}
