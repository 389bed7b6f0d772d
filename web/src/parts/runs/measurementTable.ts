// Measurements as a table: a row a block, the whole run on top, a column a measurement. Pure.

import { inFigures, quantityOfUnit, spoken } from "../../quantities";
import type { RunMeasurements } from "../../live/types";

export interface Column {
  readonly name: string;
  readonly title: string;
  readonly symbol: string;
}

export interface Row {
  readonly block: number | null;
  readonly kind: string;
  /** One figure a column; empty where the block has none. */
  readonly cells: readonly { readonly text: string; readonly failed: boolean }[];
}

export function measurementTable({ blocks, run, criteria }: RunMeasurements): { columns: Column[]; rows: Row[] } {
  const all = [{ block: null, kind: "Whole run", measurements: run }, ...blocks];
  const columns = new Map<string, Column>();
  for (const { measurements } of all) {
    for (const { name, unit } of measurements) {
      if (!columns.has(name)) {
        columns.set(name, { name, title: spoken(name), symbol: quantityOfUnit(unit, name).symbol });
      }
    }
  }
  const failed = new Set(
    criteria.filter(({ outcome }) => outcome === "fail").map(({ measurement, block }) => key(measurement, block)),
  );
  const rows = all.map(({ block, kind, measurements }): Row => {
    const found = new Map(measurements.map((measurement) => [measurement.name, measurement]));
    const cells = [...columns.keys()].map((name) => {
      const measurement = found.get(name);
      const text = measurement ? inFigures(measurement.value, measurement.unit, name) : "";
      return { text, failed: failed.has(key(name, block)) };
    });
    return { block, kind: kind.replaceAll("_", " "), cells };
  });
  return { columns: [...columns.values()], rows };
}

const key = (name: string, block: number | null | undefined): string =>
  `${name} ${block === null || block === undefined || block < 0 ? "" : block}`;
