// The table of a load spectrum: what is pasted into it, and what it adds up to. Cells show the units of the table.

import { FORCE, FREQUENCY, fromEntry, PLAIN, type Quantity } from "../../units";
import type { Layer } from "./types";

export interface LayerColumn {
  readonly key: keyof Layer;
  readonly label: string;
  readonly quantity: Quantity;
  readonly whole: boolean;
}

export const LAYER_COLUMNS: readonly LayerColumn[] = [
  { key: "mean_n", label: "Mean", quantity: FORCE, whole: false },
  { key: "amplitude_n", label: "Amplitude", quantity: FORCE, whole: false },
  { key: "frequency_hz", label: "Frequency", quantity: FREQUENCY, whole: false },
  { key: "cycles", label: "Cycles", quantity: PLAIN, whole: true },
];

export const NEW_LAYER: Layer = { mean_n: 0, amplitude_n: 1000, frequency_hz: 10, cycles: 100 };

/** Cells of a paste: rows by line, columns by tab, or by semicolon where there is no tab. */
export function cellsOf(text: string): string[][] {
  const lines = text.replace(/\r\n?/g, "\n").split("\n").filter((line) => line.trim() !== "");
  const separator = lines.some((line) => line.includes("\t")) ? "\t" : ";";
  return lines.map((line) => line.split(separator).map((cell) => cell.trim()));
}

export type Paste =
  /** One cell: the field takes it as it takes any text. */
  | { readonly kind: "cell" }
  /** It has a header: the server reads it, with the units that the header names. */
  | { readonly kind: "table" }
  /** Figures only, in the units of the table, from the cell where the cursor is. */
  | { readonly kind: "figures"; readonly cells: readonly (readonly string[])[] };

/** What was pasted. */
export function pasteOf(text: string): Paste {
  const cells = cellsOf(text);
  if (cells.length === 0 || (cells.length === 1 && cells[0]!.length === 1 && !/[,;]\s*\S+[,;]/.test(text)))
    return { kind: "cell" };
  const figures = cells.every((row) => row.every((cell) => cell === "" || fromEntry(PLAIN, cell) !== null));
  return figures ? { kind: "figures", cells } : { kind: "table" };
}

/** The layers with figures put over them from a cell on; rows that are missing are added. */
export function withFigures(
  layers: readonly Layer[],
  row: number,
  column: number,
  cells: readonly (readonly string[])[],
): Layer[] {
  const out = [...layers];
  cells.forEach((line, i) => {
    const at = row + i;
    const layer: Record<string, number> = { ...(out[at] ?? out.at(-1) ?? NEW_LAYER) };
    line.forEach((cell, j) => {
      const info = LAYER_COLUMNS[column + j];
      const value = info === undefined ? null : fromEntry(info.quantity, cell);
      if (info !== undefined && value !== null) layer[info.key] = value;
    });
    out[at] = layer as unknown as Layer;
  });
  return out;
}

/** Cycles and time (s) of layers, each a pass; transitions between them and between the passes are not counted. */
export function totals(layers: readonly Partial<Layer>[], repeats: number): { cycles: number; duration_s: number } {
  let cycles = 0;
  let duration_s = 0;
  for (const layer of layers) {
    const count = layer.cycles ?? 0;
    cycles += count;
    duration_s += layer.frequency_hz ? count / layer.frequency_hz : 0;
  }
  return { cycles: cycles * repeats, duration_s: duration_s * repeats };
}

/** Figures separated by spaces or semicolons, in SI; null where one of them is none. */
export function figuresIn(quantity: Quantity, text: string): number[] | null {
  const values = text.split(/[\s;]+/).filter((word) => word !== "").map((word) => fromEntry(quantity, word));
  return values.some((value) => value === null) ? null : (values as number[]);
}
