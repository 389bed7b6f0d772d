// Where a fault is shown: at the field of the form and at the line of the YAML that it is about.

import { FORCE, FORCE_RATE, LENGTH, SPEED, toEntry, type Quantity } from "../../units";
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

const FIGURE = /(?<![\w.])(-?\d[\d,]*(?:\.\d+)?(?:e[+-]?\d+)?) (N\/s|m\/s|N|m)(?![\w/])/g;
const BY_UNIT: Readonly<Record<string, Quantity>> = { N: FORCE, "N/s": FORCE_RATE, m: LENGTH, "m/s": SPEED };

/** A sentence of the server's in the units of the form: `60 kN must be at most 50 kN`. */
export const inFormUnits = (message: string): string =>
  message.replace(FIGURE, (said: string, figure: string, unit: string) => {
    const [quantity, si] = [BY_UNIT[unit], Number(figure.replaceAll(",", ""))];
    return quantity === undefined || !Number.isFinite(si) ? said : `${toEntry(quantity, si)} ${quantity.symbol}`;
  });

const samePath = (a: Path, b: Path): boolean => a.length === b.length && isWithin(a, b);
