// What differs between two definitions and two texts, where the server has only one of them.

import { isBranch, written, type Json, type Path } from "./tree";
import type { Change } from "./types";

/** Structural changes, key by key in the order of the definition; entries of a list by their place. */
export function changesBetween(before: Json, after: Json, path: Path = []): Change[] {
  if (Object.is(before, after)) return [];
  if (!isBranch(before) || !isBranch(after) || Array.isArray(before) !== Array.isArray(after))
    return [{ path: written(path), before, after, kind: "changed" }];
  const keys = [...new Set([...Object.keys(before), ...Object.keys(after)])];
  return keys.flatMap((name) => {
    const key = Array.isArray(before) ? Number(name) : name;
    const here = [...path, key];
    const [a, b] = [before[key], after[key]];
    if (a === undefined) return [{ path: written(here), after: b, kind: "added" }];
    if (b === undefined) return [{ path: written(here), before: a, kind: "removed" }];
    return changesBetween(a, b, here);
  });
}

export interface DiffLine {
  readonly sign: " " | "+" | "-" | "@";
  readonly text: string;
}

/** The lines of a unified difference, without the names of its files. */
export function linesOf(unified: string): DiffLine[] {
  const lines = unified.split("\n").filter((line) => !/^(---|\+\+\+)( |$)/.test(line) && line !== "");
  return lines.map((line) => {
    const sign = ["+", "-", "@"].find((known) => line.startsWith(known)) as "+" | "-" | "@" | undefined;
    return { sign: sign ?? " ", text: sign === "@" ? line : line.slice(1) };
  });
}

/** Lines taken away, added and kept between two texts: the fewest changes. */
export function textChanges(before: string, after: string): DiffLine[] {
  const [a, b] = [before.trimEnd().split("\n"), after.trimEnd().split("\n")];
  const common = lengths(a, b);
  const out: DiffLine[] = [];
  let [i, j] = [0, 0];
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      out.push({ sign: " ", text: a[i]! });
      i += 1;
      j += 1;
    } else if (j < b.length && (i === a.length || common[i]![j + 1]! > common[i + 1]![j]!)) {
      out.push({ sign: "+", text: b[j]! });
      j += 1;
    } else {
      out.push({ sign: "-", text: a[i]! });
      i += 1;
    }
  }
  return out;
}

/** Length of the longest common run of lines of a[i:] and b[j:]. */
function lengths(a: readonly string[], b: readonly string[]): number[][] {
  const table = Array.from({ length: a.length + 1 }, () => new Array<number>(b.length + 1).fill(0));
  for (let i = a.length - 1; i >= 0; i -= 1)
    for (let j = b.length - 1; j >= 0; j -= 1)
      table[i]![j] =
        a[i] === b[j] ? table[i + 1]![j + 1]! + 1 : Math.max(table[i + 1]![j]!, table[i]![j + 1]!);
  return table;
}
