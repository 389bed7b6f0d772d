// Where a fault is shown: at the field of the form and at the line of the YAML that it is about.

import { isWithin, parsePath, type Path } from "./tree";
import type { Fault } from "./types";

/** The faults of exactly this key. */
export const faultsAt = (faults: readonly Fault[], path: Path): readonly Fault[] =>
  faults.filter((fault) => samePath(parsePath(fault.path), path));

/** The faults of this key and of everything below it. */
export const faultsWithin = (faults: readonly Fault[], path: Path): readonly Fault[] =>
  faults.filter((fault) => isWithin(parsePath(fault.path), path));

/** The faults below a key for which the form has no field: shown at the key itself. */
export function faultsBeside(faults: readonly Fault[], path: Path, fields: readonly string[]): readonly Fault[] {
  return faultsWithin(faults, path).filter((fault) => {
    const key = parsePath(fault.path)[path.length];
    return key === undefined || !fields.includes(String(key));
  });
}

/** The faults by line of the text, from 1. */
export function faultsByLine(faults: readonly Fault[]): ReadonlyMap<number, string> {
  const lines = new Map<number, string>();
  for (const { line, message, path } of faults) {
    if (line === null) continue;
    const said = lines.get(line);
    const text = path === "" ? message : `${path}: ${message}`;
    lines.set(line, said === undefined ? text : `${said}\n${text}`);
  }
  return lines;
}

const samePath = (a: Path, b: Path): boolean => a.length === b.length && isWithin(a, b);
