// The blocks of a test as the rows of an outline: repeats are opened, what they hold is one step in.

import { listAt, type Json, type Path } from "./tree";
import type { Block } from "./kinds";

export interface Row {
  readonly path: Path;
  readonly block: Block;
  readonly depth: number;
  /** `3`, or `3.1` within a repeat: as a person counts. */
  readonly number: string;
}

/** Rows of a list of blocks, the ones within repeats after the repeat itself. */
export function rowsOf(tree: Json, list: Path, depth = 0, prefix = ""): Row[] {
  return listAt(tree, list).flatMap((item, i) => {
    const path = [...list, i];
    const number = `${prefix}${i + 1}`;
    const block = (typeof item === "object" && item !== null && !Array.isArray(item) ? item : {}) as Block;
    return [
      { path, block, depth, number },
      ...rowsOf(tree, [...path, "blocks"], depth + 1, `${number}.`),
    ];
  });
}

const PAGE = 10;
const STEPS: Readonly<Record<string, (at: number, last: number) => number>> = {
  ArrowDown: (at) => at + 1,
  ArrowUp: (at) => at - 1,
  PageDown: (at) => at + PAGE,
  PageUp: (at) => at - PAGE,
  Home: () => 0,
  End: (_, last) => last,
};

/** Where a key leads to from a row of so many; null where it leads nowhere. */
export function rowAfter(key: string, at: number, rows: number): number | null {
  const step = STEPS[key];
  return step === undefined ? null : Math.min(Math.max(0, step(at, rows - 1)), rows - 1);
}
