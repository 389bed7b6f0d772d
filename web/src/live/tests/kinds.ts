// The kinds of blocks and motions as forms: their fields with units and defaults. A table, as the contract has it.

import {
  ANGLE,
  duration,
  FORCE,
  FORCE_RATE,
  FREQUENCY,
  LENGTH,
  OCTAVES,
  PLAIN,
  SPEED,
  TIME,
  toEntry,
  type Quantity,
} from "../../units";
import { adapts, RESPONSE_ITEMS } from "./responseItems";
import { NEW_LAYER } from "./spectrum";
import type { Json } from "./tree";

export type Block = { readonly [key: string]: Json };

export interface FieldInfo {
  readonly key: string;
  readonly label: string;
  readonly quantity: Quantity;
  readonly whole?: boolean;
  /** What holds where the field is empty: words in the field; undefined where it must be filled. */
  readonly empty?: string;
}

export type FormItem = FormPart & {
  /** Whether it is asked at all of such a block; always without. */
  readonly when?: (block: Block) => boolean;
};

type FormPart =
  | { readonly form: "field"; readonly field: FieldInfo }
  /** Exactly one of these; `start` is what it begins with when it is chosen. */
  | { readonly form: "either"; readonly fields: readonly (FieldInfo & { readonly start: number })[] }
  | {
      readonly form: "choice";
      readonly key: string;
      readonly label: string;
      readonly options: readonly string[];
      readonly empty: string;
      /** Which keys go with each choice, since they are of another. */
      readonly drops?: Readonly<Record<string, readonly string[]>>;
    }
  | { readonly form: "list"; readonly field: FieldInfo }
  /** A list, or a range from, to and points. */
  | { readonly form: "range"; readonly key: string; readonly label: string }
  /** A list that may be left out; `of` is the key of only one. */
  | { readonly form: "means"; readonly key: string; readonly of: string; readonly label: string; readonly quantity: Quantity }
  /** A key with keys of its own, there or not; `start` is what it begins with. */
  | { readonly form: "group"; readonly key: string; readonly label: string; readonly start: Block; readonly fields: readonly FieldInfo[] }
  | { readonly form: "bands"; readonly key: string; readonly label: string }
  | { readonly form: "layers" | "history" };

export interface KindInfo {
  readonly kind: string;
  readonly label: string;
  readonly does: string;
  readonly items: readonly FormItem[];
  readonly make: () => Block;
  readonly summary: (block: Block) => string;
}

const field = (
  key: string,
  label: string,
  quantity: Quantity,
  more: Partial<FieldInfo> = {},
): FormItem => ({ form: "field", field: { key, label, quantity, ...more } });

const CYCLES = { key: "cycles", label: "Cycles", quantity: PLAIN, whole: true, start: 100 };
const DURATION = { key: "duration_s", label: "Duration", quantity: TIME, start: 10 };

/** A figure of a block in the units of the form; a dash where there is none. */
function say(quantity: Quantity, value: Json | undefined): string {
  if (typeof value !== "number") return "—";
  return quantity.symbol === "" ? toEntry(quantity, value) : `${toEntry(quantity, value)}\u00a0${quantity.symbol}`;
}
const lasting = (block: Block): string =>
  typeof block.cycles === "number"
    ? `${say(PLAIN, block.cycles)} cycles`
    : duration(typeof block.duration_s === "number" ? block.duration_s : null);

const count = (value: Json | undefined): number => (Array.isArray(value) ? value.length : 0);

function about(quantity: Quantity, block: Block, key: string): string {
  const mean = block[key];
  return typeof mean === "number" && mean !== 0 ? ` about ${say(quantity, mean)}` : "";
}

interface Axis {
  readonly value: Quantity;
  readonly rate: Quantity;
  readonly to: string;
  readonly rateKey: string;
  readonly hold: string;
  readonly amplitude: string;
  readonly mean: string;
  readonly word: string;
  readonly start: { readonly to: number; readonly rate: number; readonly amplitude: number };
}

const AXES: Record<"force" | "motion", Axis> = {
  force: {
    ...{ value: FORCE, rate: FORCE_RATE, to: "to_n", rateKey: "rate_n_s", hold: "force_n" },
    ...{ amplitude: "amplitude_n", mean: "mean_n", word: "Force" },
    start: { to: 2000, rate: 20000, amplitude: 2000 },
  },
  motion: {
    ...{ value: LENGTH, rate: SPEED, to: "to_m", rateKey: "rate_m_s", hold: "displacement_m" },
    ...{ amplitude: "amplitude_m", mean: "mean_m", word: "Displacement" },
    start: { to: 0.002, rate: 0.01, amplitude: 0.002 },
  },
};

function basicKinds(axis: Axis, frequency_hz: number, taper: string): KindInfo[] {
  const { value, rate, to, rateKey, hold, amplitude, mean, start } = axis;
  return [
    {
      ...{ kind: "hold", label: "Hold", does: "Stays for a time" },
      items: [
        field(hold, axis.word, value, { empty: "where it is" }),
        field("duration_s", "Duration", TIME),
      ],
      make: () => ({ kind: "hold", duration_s: 1 }),
      summary: (block) =>
        `${block[hold] === undefined || block[hold] === null ? "Where it is" : say(value, block[hold])}, ${lasting(block)}`,
    },
    {
      ...{ kind: "ramp", label: "Ramp", does: "Goes there at a constant rate" },
      items: [
        field(to, "To", value),
        {
          form: "either",
          fields: [
            { key: rateKey, label: "Rate", quantity: rate, start: start.rate },
            { ...DURATION, start: 1 },
          ],
        },
      ],
      make: () => ({ kind: "ramp", [to]: start.to, [rateKey]: start.rate }),
      summary: (block) =>
        typeof block[rateKey] === "number"
          ? `To ${say(value, block[to])} at ${say(rate, block[rateKey])}`
          : `To ${say(value, block[to])} in ${lasting(block)}`,
    },
    {
      ...{ kind: "step", label: "Step", does: "Jumps there and stays" },
      items: [
        field(to, "To", value),
        field("hold_s", "Stay for", TIME),
        field("rise_s", "Rise in", TIME, { empty: "0" }),
      ],
      make: () => ({ kind: "step", [to]: start.to, hold_s: 1 }),
      summary: (block) => `To ${say(value, block[to])}, stays ${say(TIME, block.hold_s)}`,
    },
    {
      ...{ kind: "harmonic", label: "Harmonic", does: "A sine about a mean" },
      items: [
        field(amplitude, "Amplitude", value),
        field(mean, "Mean", value, { empty: "0" }),
        field("frequency_hz", "Frequency", FREQUENCY),
        { form: "either", fields: [CYCLES, DURATION] },
        field("phase_deg", "Phase", ANGLE, { empty: "0" }),
        field("taper_cycles", "Taper", { ...PLAIN, symbol: "cycles" }, { empty: taper }),
      ],
      make: () => ({ kind: "harmonic", [mean]: 0, [amplitude]: start.amplitude, frequency_hz, cycles: 100 }),
      summary: (block) =>
        `${say(value, block[amplitude])}${about(value, block, mean)} at ${say(FREQUENCY, block.frequency_hz)}, ${lasting(block)}`,
    },
  ];
}

function historyKind(samples: string): KindInfo {
  return {
    ...{ kind: "time_history", label: "Time history", does: "Plays a recorded signal" },
    items: [
      { form: "history" },
      field("rate_hz", "Sample rate", FREQUENCY, { empty: "of the file" }),
      field("gain", "Gain", PLAIN, { empty: "1" }),
      field("repeats", "Times", PLAIN, { whole: true, empty: "1" }),
    ],
    make: () => ({ kind: "time_history", file: "", gain: 1 }),
    summary: (block) => {
      const source = typeof block.file === "string" ? block.file || "no file yet" : `${count(block[samples])} samples`;
      const gain = typeof block.gain === "number" && block.gain !== 1 ? ` × ${say(PLAIN, block.gain)}` : "";
      const times = typeof block.repeats === "number" && block.repeats > 1 ? `, ${block.repeats} times` : "";
      return source + gain + times;
    },
  };
}

const frequenciesOf = (block: Block): string => {
  const range = block.frequencies_hz;
  if (Array.isArray(range)) return `${range.length} frequencies`;
  const { from_hz, to_hz } = (range ?? {}) as Record<string, Json>;
  return `${say(FREQUENCY, from_hz)} to ${say(FREQUENCY, to_hz)}`;
};

export const BLOCK_KINDS: readonly KindInfo[] = [
  ...basicKinds(AXES.force, 50, "2"),
  {
    ...{ kind: "layers", label: "Layers", does: "A load spectrum: layers of harmonic load" },
    items: [
      { form: "layers" },
      field("transition_s", "Transition", TIME),
      field("repeats", "Times", PLAIN, { whole: true, empty: "1" }),
    ],
    make: () => ({ kind: "layers", layers: [{ ...NEW_LAYER }], repeats: 1, transition_s: 0.2 }),
    summary: (block) => {
      const layers = count(block.layers);
      return `${layers} ${layers === 1 ? "layer" : "layers"}, ${say(PLAIN, block.repeats ?? 1)} ×`;
    },
  },
  {
    ...{ kind: "sweep", label: "Sweep", does: "A sine whose frequency moves" },
    items: [
      field("amplitude_n", "Amplitude", FORCE),
      field("mean_n", "Mean", FORCE, { empty: "0" }),
      field("from_hz", "From", FREQUENCY),
      field("to_hz", "To", FREQUENCY),
      {
        form: "either",
        fields: [
          { key: "rate_octaves_s", label: "Rate", quantity: OCTAVES, start: 0.5 },
          { ...DURATION, start: 20 },
        ],
      },
      { form: "choice", key: "law", label: "Law", options: ["log", "linear"], empty: "log" },
      field("taper_cycles", "Taper", { ...PLAIN, symbol: "cycles" }, { empty: "2" }),
    ],
    make: () => ({ kind: "sweep", mean_n: 0, amplitude_n: 500, from_hz: 1, to_hz: 50, rate_octaves_s: 0.5 }),
    summary: (block) =>
      `${say(FORCE, block.amplitude_n)}, ${say(FREQUENCY, block.from_hz)} to ${say(FREQUENCY, block.to_hz)}`,
  },
  {
    ...{ kind: "frequency_response", label: "Frequency response", does: "Excites for a Bode diagram" },
    items: RESPONSE_ITEMS,
    make: () => ({
      kind: "frequency_response",
      method: "stepped_sine",
      amplitudes_n: [500],
      frequencies_hz: { from_hz: 1, to_hz: 100, points: 20 },
      settle_cycles: 5,
      measure_cycles: 10,
    }),
    summary: (block) =>
      `${adapts(block) ? "adaptive " : ""}${String(block.method ?? "stepped_sine").replace("_", " ")}, ${count(block.amplitudes_n) * Math.max(1, count(block.means_n))} × ${frequenciesOf(block)}`,
  },
  historyKind("samples_n"),
  {
    ...{ kind: "repeat", label: "Repeat", does: "The blocks within, so many times" },
    items: [field("times", "Times", PLAIN, { whole: true })],
    make: () => ({ kind: "repeat", times: 10, blocks: [{ kind: "hold", duration_s: 1 }] }),
    summary: (block) => {
      const blocks = count(block.blocks);
      return `${blocks} ${blocks === 1 ? "block" : "blocks"}, ${say(PLAIN, block.times)} times`;
    },
  },
];

export const MOTION_KINDS: readonly KindInfo[] = [
  ...basicKinds(AXES.motion, 4, "1"),
  {
    ...{ kind: "multisine", label: "Multisine", does: "Measures the unit's position response" },
    items: [
      field("amplitude_m", "Amplitude", LENGTH),
      field("mean_m", "Mean", LENGTH, { empty: "0" }),
      { form: "range", key: "frequencies_hz", label: "Frequencies" },
      field("corner_hz", "Falls above", FREQUENCY, { empty: "never" }),
      field("settle_cycles", "Settle", { ...PLAIN, symbol: "periods" }, { whole: true, empty: "1" }),
      field("measure_cycles", "Measure", { ...PLAIN, symbol: "periods" }, { whole: true, empty: "2" }),
      field("realisations", "Realisations", PLAIN, { whole: true, empty: "4" }),
    ],
    make: () => ({
      kind: "multisine",
      amplitude_m: 0.0005,
      frequencies_hz: { from_hz: 2, to_hz: 100, points: 20 },
    }),
    summary: (block) => `${say(LENGTH, block.amplitude_m)}, ${frequenciesOf(block)}`,
  },
  historyKind("samples_m"),
];

const BY_KIND: Record<"blocks" | "motion", ReadonlyMap<string, KindInfo>> = {
  blocks: new Map(BLOCK_KINDS.map((info) => [info.kind, info])),
  motion: new Map(MOTION_KINDS.map((info) => [info.kind, info])),
};

/** The kind of a block, if the form knows it. `path` begins with the list that it is in. */
export const kindOf = (block: Block, where: "blocks" | "motion"): KindInfo | null =>
  BY_KIND[where].get(String(block.kind)) ?? null;

/** What a form asks of a block as it is. */
export const itemsFor = (info: KindInfo, block: Block): readonly FormItem[] =>
  info.items.filter(({ when }) => when === undefined || when(block));

/** The keys of a kind that have a field of their own. */
export const keysOf = (info: KindInfo, block: Block): string[] =>
  itemsFor(info, block).flatMap((item) => {
    if (item.form === "field" || item.form === "list") return [item.field.key];
    if (item.form === "either") return item.fields.map((entry) => entry.key);
    if (item.form === "layers") return ["layers"];
    if (item.form === "history") return ["file", "samples_n", "samples_m"];
    return [(item as Extract<FormItem, { key: string }>).key];
  });

export const NEW_TEST = {
  schema: 1,
  name: "New test",
  description: "",
  blocks: [
    { kind: "hold", force_n: 0, duration_s: 0.5 },
    { kind: "harmonic", mean_n: 0, amplitude_n: 2000, frequency_hz: 10, cycles: 20 },
  ],
} as const satisfies Block;
