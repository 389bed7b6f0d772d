// What an analysis says, as tables that people read. Pure.

import type { Analysis } from "../../live/responses/types";
import { inFigures } from "../../quantities";
import { count, figure, FORCE, NOTHING, PERCENT, TIME, type Quantity } from "../../units";

export interface Table {
  /** `words`: a column of sentences, not of figures. */
  readonly columns: readonly { readonly title: string; readonly symbol: string; readonly words?: boolean }[];
  readonly rows: readonly { readonly head: string; readonly cells: readonly string[] }[];
}

type Number = number | null | undefined;
const n = (value: Number): string => inFigures(value, "N");
const percent = (value: Number): string => figure(PERCENT, value, 1);
const milliseconds: Quantity = { label: "", symbol: "ms", scale: 1e3, digits: 2 };
const HOW = { title: "How", symbol: "", words: true } as const;
const column = (title: string, symbol = ""): Table["columns"][number] => ({ title, symbol });

const spread = ({ mean, deviation }: { mean: Number; deviation: Number }): string =>
  deviation == null ? n(mean) : `${n(mean)} ± ${n(deviation)}`;

/** One row a step of the setpoint. */
export const stepTable = ({ steps }: Analysis): Table => ({
  columns: [
    ...[column("From", FORCE.symbol), column("To", FORCE.symbol), column("Dead time", "ms"), column("Rise", "ms")],
    ...[column("Overshoot", "%"), column("Settling", "ms"), column("Steady error", FORCE.symbol)],
  ],
  rows: steps.map((step) => ({
    head: `Block ${step.block + 1}, ${figure(TIME, step.time_s, 1)}\u00a0s`,
    cells: [
      n(step.begin_n),
      n(step.end_n),
      figure(milliseconds, step.dead_time_s),
      figure(milliseconds, step.rise_s),
      percent(step.overshoot_percent),
      figure(milliseconds, step.settling_s),
      n(step.steady_error_n),
    ],
  })),
});

/** One row a layer: what was asked for, and how far it was off. */
export const layerTable = (analysis: Analysis): Table => ({
  columns: [
    ...[column("Cycles"), column("Amplitude", FORCE.symbol), column("off by", "%"), column("Mean", FORCE.symbol)],
    ...[column("Phase", "°"), column("Distortion", "%"), column("Peak", FORCE.symbol), column("Valley", FORCE.symbol)],
  ],
  rows: analysis.layers.map((layer) => ({
    head: asked(layer, ofSeveralBlocks(analysis)),
    cells: [
      count(layer.cycles),
      n(layer.amplitude_n),
      percent(layer.amplitude_error_percent),
      n(layer.mean_n),
      layer.phase_deg == null ? NOTHING : inFigures(layer.phase_deg, "deg"),
      percent(layer.distortion_percent),
      spread(layer.peak_n),
      spread(layer.valley_n),
    ],
  })),
});

const ofSeveralBlocks = ({ layers, steps, unit }: Analysis): boolean =>
  new Set([...layers, ...steps, ...unit].map(({ block }) => block)).size > 1;

/** What was asked for; the block of it too, where what is told is of several. */
function asked({ block, asked: sine }: Pick<Analysis["layers"][number], "block" | "asked">, several: boolean): string {
  const where = several ? [`Block ${block + 1}`] : [];
  if (!sine) return [...where, where.length > 0 ? "sweep" : "Sweep"].join(", ");
  const about = sine.mean_n === 0 ? "" : ` about ${n(sine.mean_n)}\u00a0kN`;
  const hz = Number(sine.frequency_hz.toPrecision(4));
  return [...where, `${n(sine.amplitude_n)}\u00a0kN${about} at ${hz}\u00a0Hz`].join(", ");
}

const scaled = (value: Number, scale: number): string => (value == null ? NOTHING : Number((scale * value).toPrecision(3)).toString());

/** One row a slow sine: the unit under test as it gives way to a force that pushes and pulls. */
export const unitTable = (analysis: Analysis): Table => ({
  columns: [
    ...[column("Cycles"), column("Static stiffness", "kN/mm"), column("± σ", "kN/mm")],
    ...[column("Hysteresis", "J"), column("± σ", "J"), column("Backlash", "µm")],
  ],
  rows: analysis.unit.map((one) => ({
    head: asked(one, ofSeveralBlocks(analysis)),
    cells: [
      count(one.cycles),
      scaled(one.stiffness_n_m, 1e-6),
      scaled(one.stiffness_std_n_m, 1e-6),
      scaled(one.hysteresis_j, 1),
      scaled(one.hysteresis_std_j, 1),
      scaled(one.backlash_m, 1e6),
    ],
  })),
});

/** The error budget, the largest first. */
export const budgetTable = ({ uncertainty }: Analysis): Table => ({
  columns: [column("Bound", "N"), column("Distribution"), column("Standard", "N"), column("From"), HOW],
  rows: [...uncertainty.contributions]
    .sort((a, b) => b.standard_n - a.standard_n)
    .map((one) => ({
      head: one.name,
      cells: [newtons(one.value_n), one.shape, newtons(one.standard_n), one.source, one.how],
    })),
});

const newtons = (value: number): string => (Math.abs(value) >= 100 ? value.toFixed(0) : value.toPrecision(2));

/** One row an exponent of the Wöhler line. */
export const damageTable = ({ damage }: Analysis): Table => ({
  columns: [column("Asked for, amplitude", FORCE.symbol), column("Applied, amplitude", FORCE.symbol), column("Damage", "×")],
  rows: damage.map((one) => ({
    head: `Exponent ${one.exponent}`,
    cells: [figure(FORCE, one.asked_amplitude_n, 1), figure(FORCE, one.applied_amplitude_n, 1), one.ratio == null ? NOTHING : one.ratio.toFixed(3)],
  })),
});

export interface Class {
  readonly label: string;
  readonly asked: number;
  readonly applied: number;
  /** Of the longest bar, by the logarithm of the count. */
  readonly askedShare: number;
  readonly appliedShare: number;
}

/** The classes of range in which there is a cycle, the greatest first. */
export function rangeClasses({ rainflow: { spectrum } }: Analysis): readonly Class[] {
  const filled = spectrum.filter(({ asked: a, applied }) => a > 0 || applied > 0);
  const most = Math.max(1, ...filled.flatMap((one) => [one.asked, one.applied]));
  const share = (cycles: number): number => Math.log10(1 + cycles) / Math.log10(1 + most);
  return [...filled].reverse().map((one) => ({
    label: `${n(one.from_n)} to ${n(one.to_n)}`,
    asked: one.asked,
    applied: one.applied,
    askedShare: share(one.asked),
    appliedShare: share(one.applied),
  }));
}
