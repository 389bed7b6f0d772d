import { describe, expect, it } from "vitest";
import { rowAfter, rowsOf } from "./rows";
import {
  blockOf,
  duplicateAt,
  getAt,
  insertAt,
  isWithin,
  moveBlock,
  parsePath,
  removeAt,
  setAt,
  written,
  type Json,
  type Moved,
  type Path,
} from "./tree";

const hold = (force_n: number): Json => ({ kind: "hold", force_n });
const TEST: Json = {
  schema: 1,
  blocks: [hold(1), { kind: "repeat", times: 2, blocks: [hold(2), hold(3)] }, hold(4)],
};

/** The blocks as nested lists of forces. */
function shape(tree: Json, list: Path = ["blocks"]): unknown[] {
  return rowsOf(tree, list)
    .filter((row) => row.depth === 0)
    .map((row) => (row.block.kind === "repeat" ? shape(tree, [...row.path, "blocks"]) : row.block.force_n));
}

describe("edits of a tree", () => {
  it("sets what is deep down, and leaves the tree before as it was", () => {
    const before = structuredClone(TEST);
    const after = setAt(TEST, ["blocks", 1, "blocks", 0, "force_n"], 9);
    expect(getAt(after, ["blocks", 1, "blocks", 0, "force_n"])).toBe(9);
    expect(TEST).toEqual(before);
    expect(getAt(after, ["blocks", 2])).toBe(getAt(TEST, ["blocks", 2]));
  });

  it("makes what is missing on the way, and takes keys and items away", () => {
    expect(setAt({}, ["record", "also", 0, "kind"], "timed")).toEqual({ record: { also: [{ kind: "timed" }] } });
    expect(setAt({ a: 1, b: 2 }, ["a"], undefined)).toEqual({ b: 2 });
    expect(shape(removeAt(TEST, ["blocks", 0]))).toEqual([[2, 3], 4]);
    expect(shape(insertAt(TEST, ["blocks"], 1, hold(7)))).toEqual([1, 7, [2, 3], 4]);
    expect(shape(duplicateAt(TEST, ["blocks", 1]))).toEqual([1, [2, 3], [2, 3], 4]);
  });
});

describe("moving a block", () => {
  const moved = (path: Path, by: -1 | 1): [unknown[], string] => {
    const { tree, path: now } = moveBlock(TEST, path, by);
    return [shape(tree), written(now)];
  };

  it("goes into a repeat and out of it", () => {
    expect(moved(["blocks", 0], 1)).toEqual([[[1, 2, 3], 4], "blocks[0].blocks[0]"]);
    expect(moved(["blocks", 2], -1)).toEqual([[1, [2, 3, 4]], "blocks[1].blocks[2]"]);
    expect(moved(["blocks", 1, "blocks", 0], -1)).toEqual([[1, 2, [3], 4], "blocks[1]"]);
    expect(moved(["blocks", 1, "blocks", 1], 1)).toEqual([[1, [2], 3, 4], "blocks[2]"]);
    expect(moved(["blocks", 1, "blocks", 0], 1)).toEqual([[1, [3, 2], 4], "blocks[1].blocks[1]"]);
  });

  it("stays at the ends of the test", () => {
    expect(moved(["blocks", 0], -1)).toEqual([[1, [2, 3], 4], "blocks[0]"]);
    expect(moved(["blocks", 2], 1)).toEqual([[1, [2, 3], 4], "blocks[2]"]);
  });

  it("comes back: down and up again leave every block where it was", () => {
    for (const { path } of rowsOf(TEST, ["blocks"])) {
      const down: Moved<Json> = moveBlock(TEST, path, 1);
      if (down.tree !== TEST) expect(moveBlock(down.tree, down.path, -1).tree).toEqual(TEST);
    }
  });
});

describe("paths", () => {
  it("are written as the server writes them, and read back", () => {
    for (const text of ["", "name", "blocks[1].layers[20].mean_n", "motion[0]"])
      expect(written(parsePath(text))).toBe(text);
    expect(parsePath("blocks[1].to_n")).toEqual(["blocks", 1, "to_n"]);
    expect(isWithin(["blocks", 1, "to_n"], ["blocks", 1])).toBe(true);
    expect(isWithin(["blocks", 11], ["blocks", 1])).toBe(false);
  });

  it("lead into a block, the innermost", () => {
    const block = (path: string): string => written(blockOf(parsePath(path)));
    expect(block("blocks[1].blocks[0].layers[2].cycles")).toBe("blocks[1].blocks[0]");
    expect(block("motion[3].to_m")).toBe("motion[3]");
    expect(block("acceptance[0].at_most")).toBe("");
  });

  it("are numbered as a person counts", () => {
    expect(rowsOf(TEST, ["blocks"]).map((row) => row.number)).toEqual(["1", "2", "2.1", "2.2", "3"]);
  });
});

describe("keys in a list", () => {
  it("lead to rows that there are", () => {
    expect(["ArrowDown", "ArrowUp", "PageDown", "PageUp", "Home", "End"].map((key) => rowAfter(key, 2, 15))).toEqual([
      3, 1, 12, 0, 0, 14,
    ]);
    expect(rowAfter("ArrowDown", 14, 15)).toBe(14);
    expect(rowAfter("x", 2, 15)).toBeNull();
  });
});
