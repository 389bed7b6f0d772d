// The form of a frequency response: which keys there are with which method. A table, as the contract has it.

import { ANGLE, DECIBEL, FORCE, FREQUENCY, LENGTH, PLAIN, type Quantity } from "../../units";
import type { Block, FieldInfo, FormItem } from "./kinds";

const CYCLES: Quantity = { ...PLAIN, symbol: "cycles" };
const PERIODS: Quantity = { ...PLAIN, symbol: "periods" };
const STEPPED = { when: (block: Block) => block.method !== "multisine" };
const MULTISINE = { when: (block: Block) => block.method === "multisine" };

const field = (key: string, label: string, quantity: Quantity, empty: string, more: Partial<FieldInfo> = {}): FieldInfo => ({
  ...{ key, label, quantity, empty },
  ...more,
});
const WHOLE = { whole: true };

/** Several figures at once under one switch: all of them, or the key is not there. */
const GROUPS: readonly FormItem[] = [
  {
    ...{ form: "group", key: "settle", label: "Settle until it is steady", start: { until: "steady", at_most_cycles: 20 } },
    fields: [{ key: "at_most_cycles", label: "At most", quantity: CYCLES, ...WHOLE }],
    ...STEPPED,
  },
  {
    ...{ form: "group", key: "confidence", label: "End a point once it is sure", start: { gain_db: 0.05, phase_deg: 0.5 } },
    fields: [field("gain_db", "Gain within ±", DECIBEL, "0.05"), field("phase_deg", "Phase within ±", ANGLE, "0.5")],
    ...STEPPED,
  },
  {
    ...{ form: "group", key: "auto_level", label: "Lower where the valve has too much to do" },
    start: { valve_at_most: 0.8, least_share: 0.25 },
    fields: [
      field("valve_at_most", "Valve at most", { ...PLAIN, symbol: "of full" }, "0.5"),
      field("displacement_at_most_m", "Unit at most", LENGTH, "no limit"),
      field("least_share", "Not below", { ...PLAIN, symbol: "of it" }, "0.125"),
    ],
    ...STEPPED,
  },
  {
    ...{ form: "group", key: "auto_resolution", label: "Closer where the response bends" },
    start: { points: 1, bend_db: 0.5, bend_deg: 5 },
    fields: [
      { key: "points", label: "Points between two", quantity: PLAIN, ...WHOLE },
      field("bend_db", "Where it bends by", DECIBEL, "0.5"),
      field("bend_deg", "or by", ANGLE, "5"),
    ],
    ...STEPPED,
  },
];

/** What only the one method knows; away with it where the other is chosen. */
const OF_STEPPED = ["settle", "confidence", "auto_level", "auto_resolution"];
const OF_MULTISINE = ["realisations", "lines"];

export const RESPONSE_ITEMS: readonly FormItem[] = [
  {
    ...{ form: "choice", key: "method", label: "Method", empty: "stepped_sine", options: ["stepped_sine", "multisine"] },
    drops: { stepped_sine: OF_MULTISINE, multisine: OF_STEPPED },
  },
  { form: "list", field: { key: "amplitudes_n", label: "Amplitudes", quantity: FORCE } },
  { form: "means", key: "means_n", of: "mean_n", label: "Means", quantity: FORCE },
  { form: "range", key: "frequencies_hz", label: "Frequencies" },
  { form: "field", field: field("settle_cycles", "Settle", CYCLES, "2", WHOLE), ...STEPPED },
  { form: "field", field: field("measure_cycles", "Measure at most", CYCLES, "5", WHOLE), ...STEPPED },
  { form: "field", field: field("settle_cycles", "Settle", PERIODS, "2", WHOLE), ...MULTISINE },
  { form: "field", field: field("measure_cycles", "Measure", PERIODS, "5", WHOLE), ...MULTISINE },
  { form: "field", field: field("realisations", "Realisations", PLAIN, "1", WHOLE), ...MULTISINE },
  {
    ...{ form: "choice", key: "lines", label: "Lines", empty: "all", options: ["all", "odd", "odd_random"] },
    ...MULTISINE,
  },
  ...GROUPS,
  { form: "bands", key: "bands", label: "Asked for" },
];

/** The columns of a requirement band. */
export const BAND_FIELDS: readonly FieldInfo[] = [
  { key: "from_hz", label: "From", quantity: FREQUENCY },
  { key: "to_hz", label: "To", quantity: FREQUENCY },
  field("low_db", "Gain from", DECIBEL, "—"),
  field("high_db", "to", DECIBEL, "—"),
  field("low_deg", "Phase from", ANGLE, "—"),
  field("high_deg", "to", ANGLE, "—"),
];

/** How a block adapts, in a word of its summary. */
export const adapts = (block: Block): boolean => OF_STEPPED.some((key) => block[key] !== undefined && block[key] !== null);
