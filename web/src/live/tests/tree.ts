// A definition as plain data, changed without touching what was there: every edit gives a new tree.

export type Json = string | number | boolean | null | readonly Json[] | { readonly [key: string]: Json };
export type Path = readonly (string | number)[];
type Branch = Readonly<Record<string | number, Json>>;

const isList = (value: unknown): value is readonly Json[] => Array.isArray(value);
export const isBranch = (value: unknown): value is Branch => typeof value === "object" && value !== null;

/** What stands at a path; undefined where nothing does. */
export function getAt(tree: Json | undefined, path: Path): Json | undefined {
  return path.reduce<Json | undefined>(
    (at, key) => (isBranch(at) && Object.hasOwn(at, key) ? at[key] : undefined),
    tree,
  );
}

/** The list at a path; empty where there is none. */
export function listAt(tree: Json, path: Path): readonly Json[] {
  const found = getAt(tree, path);
  return isList(found) ? found : [];
}

/** The tree with a value at a path; undefined takes the key away. */
export function setAt<T extends Json>(tree: T, path: Path, value: Json | undefined): T {
  const [key, ...rest] = path;
  if (key === undefined) return (value ?? null) as T;
  const below = isBranch(tree) ? tree[key] : undefined;
  const next = rest.length === 0 ? value : setAt(below ?? (typeof rest[0] === "number" ? [] : {}), rest, value);
  if (isList(tree)) {
    return (
      next === undefined
        ? tree.filter((_, i) => i !== key)
        : Object.assign([...tree], { [key]: next })
    ) as unknown as T;
  }
  const copy: Record<string, Json> = { ...((isBranch(tree) ? tree : {}) as Record<string, Json>) };
  if (next === undefined) delete copy[key];
  else copy[key] = next;
  return copy as unknown as T;
}

/** The tree with an item put into a list, before the item that is at `index` now. */
export function insertAt<T extends Json>(tree: T, list: Path, index: number, item: Json): T {
  return setAt(tree, list, listAt(tree, list).toSpliced(index, 0, item));
}

export const removeAt = <T extends Json>(tree: T, path: Path): T => setAt(tree, path, undefined);

/** The tree with a copy behind the item at a path. */
export function duplicateAt<T extends Json>(tree: T, path: Path): T {
  const [list, index] = [path.slice(0, -1), path.at(-1) as number];
  const item = getAt(tree, path);
  return item === undefined ? tree : insertAt(tree, list, index + 1, item);
}

export interface Moved<T> {
  readonly tree: T;
  /** Where the item is now. */
  readonly path: Path;
}

/**
 * The tree with the block at a path one place up (−1) or down (+1): past its neighbour, into a neighbour that
 * repeats blocks, or out of the one that it is in. Unchanged at the ends of the test.
 */
export function moveBlock<T extends Json>(tree: T, path: Path, by: -1 | 1): Moved<T> {
  const list = path.slice(0, -1);
  const index = path.at(-1) as number;
  const item = getAt(tree, path);
  if (item === undefined) return { tree, path };
  const rest = removeAt(tree, path);
  const next = index + by;
  if (next < 0 || next >= listAt(tree, list).length) return outOf(tree, rest, path, by, item);
  const neighbour = [...list, by === 1 ? index : next]; // as it is once the item is away
  if (isList(getAt(rest, [...neighbour, "blocks"]))) {
    const inner = [...neighbour, "blocks"];
    const at = by === 1 ? 0 : listAt(rest, inner).length;
    return { tree: insertAt(rest, inner, at, item), path: [...inner, at] };
  }
  return { tree: insertAt(rest, list, next, item), path: [...list, next] };
}

function outOf<T extends Json>(tree: T, rest: T, path: Path, by: -1 | 1, item: Json): Moved<T> {
  const around = path.slice(0, -2); // the block that repeats this one
  const place = around.at(-1);
  if (typeof place !== "number") return { tree, path };
  const list = around.slice(0, -1);
  const at = by === 1 ? place + 1 : place;
  return { tree: insertAt(rest, list, at, item), path: [...list, at] };
}

/** `["blocks", 1, "to_n"]` as `blocks[1].to_n`, as the server writes it. */
export const written = (path: Path): string =>
  path.map((key) => (typeof key === "number" ? `[${key}]` : `.${key}`)).join("").replace(/^\./, "");

/** `blocks[1].to_n` as `["blocks", 1, "to_n"]`. */
export const parsePath = (text: string): Path =>
  [...text.matchAll(/\[(\d+)\]|([^.[\]]+)/g)].map(([, index, key]) =>
    index === undefined ? key! : Number(index),
  );

/** Whether a path is the other one or lies below it. */
export const isWithin = (path: Path, other: Path): boolean =>
  other.every((key, i) => path[i] === key);

/** The block (or motion) that a path leads into, the innermost; empty where it leads into none. */
export function blockOf(path: Path): Path {
  const at = path.findLastIndex(
    (key, i) => typeof key === "number" && (path[i - 1] === "blocks" || path[i - 1] === "motion"),
  );
  return path.slice(0, at + 1);
}
