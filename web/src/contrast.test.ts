// WCAG 2.2 AA for every pair of colours that the console puts together, in both themes.
import { describe, expect, it } from "vitest";
import CSS from "./app.css?raw";

const TEXT = 4.5;
const GRAPHICS = 3;

function tokens(selector: string): Map<string, string> {
  const start = CSS.indexOf(`${selector} {`);
  const block = CSS.slice(start, CSS.indexOf("}", start));
  return new Map([...block.matchAll(/(--[\w-]+): (#[0-9a-f]{6});/g)].map((match) => [match[1]!, match[2]!]));
}

/** Relative luminance, WCAG 2.2 definition. */
function luminance(colour: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const channel = parseInt(colour.slice(at, at + 2), 16) / 255;
    return channel <= 0.04045 ? channel / 12.92 : ((channel + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r! + 0.7152 * g! + 0.0722 * b!;
}

function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high! + 0.05) / (low! + 0.05);
}

const PAIRS: [string, string[], number][] = [
  ["--ink", ["--panel", "--well", "--ground"], TEXT],
  ["--ink-2", ["--panel", "--well", "--ground"], TEXT],
  ["--stale", ["--panel", "--well"], TEXT],
  ["--commanded", ["--panel", "--well"], TEXT],
  ["--on-commanded", ["--commanded"], TEXT],
  ["--trip-ink", ["--panel", "--well"], TEXT],
  ["--on-trip", ["--trip"], TEXT],
  ["--on-warn", ["--warn"], TEXT],
  ["--warn-ink", ["--panel"], TEXT],
  ["--on-stop", ["--stop"], TEXT],
  ["--edge", ["--panel", "--well"], GRAPHICS],
  ["--measured", ["--well"], GRAPHICS],
  ["--setpoint", ["--well"], GRAPHICS],
  ["--error", ["--well"], GRAPHICS],
  ["--bar", ["--well"], GRAPHICS],
  ...[1, 2, 3, 4, 5, 6].map((n): [string, string[], number] => [`--series-${n}`, ["--well"], GRAPHICS]),
  ["--commanded", ["--ground"], GRAPHICS],
];

describe.each([":root", ':root[data-theme="dark"]'])("contrast in %s", (selector) => {
  const theme = tokens(selector);
  const cases = PAIRS.flatMap(([front, backs, least]) => backs.map((back) => [front, back, least] as const));
  it.each(cases)("%s on %s is at least %d", (front, back, least) => {
    expect(contrast(theme.get(front)!, theme.get(back)!)).toBeGreaterThanOrEqual(least);
  });
});

describe("contrast", () => {
  it("is what WCAG says it is", () => {
    expect(contrast("#000000", "#ffffff")).toBeCloseTo(21, 6);
    expect(contrast("#777777", "#ffffff")).toBeCloseTo(4.478, 2);
  });
});
