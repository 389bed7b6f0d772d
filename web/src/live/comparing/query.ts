// How runs are compared, as it stands in the address: everything that is shown. Pure.

import type { Align } from "./types";

export const MOST_RUNS = 8;
export const PANES = ["measurements", "settings", "trend", "response"] as const;
export type Pane = (typeof PANES)[number];
export const ALIGNS: readonly { readonly align: Align; readonly label: string; readonly help: string }[] = [
  { align: "time", label: "Time", help: "First ticks of the runs on top of each other" },
  { align: "block", label: "Block", help: "The beginning of a block on top of each other" },
  { align: "phase", label: "Phase", help: "The mean cycle of each run, from one top of the setpoint to the next" },
];

export interface Compared {
  /** The baseline first. */
  readonly ids: readonly number[];
  readonly channel: string;
  readonly align: Align;
  readonly block: number | null;
  /** SI; null for none. */
  readonly toleranceAbs: number | null;
  /** A share; null for none. */
  readonly toleranceRel: number | null;
  /** The window that is looked at; null for all. */
  readonly window: { readonly from: number; readonly to: number } | null;
  /** Runs whose curves are hidden. */
  readonly hidden: readonly number[];
  readonly pane: Pane;
  readonly measurement: string;
}

const FIRST: Omit<Compared, "ids"> = {
  channel: "force_n",
  align: "time",
  block: null,
  toleranceAbs: null,
  toleranceRel: null,
  window: null,
  hidden: [],
  pane: "measurements",
  measurement: "peak_force_n", // every run has it
};

const numbers = (text: string | null): number[] =>
  [...new Set((text ?? "").split(",").map(Number))].filter((id) => Number.isInteger(id) && id > 0);

function amount(query: URLSearchParams, name: string): number | null {
  const text = query.get(name);
  const value = Number(text);
  return text === null || text.trim() === "" || !Number.isFinite(value) || value < 0 ? null : value;
}

/** What an address says; what it does not say is as it is at first. */
export function comparedOf(query: string): Compared {
  const words = new URLSearchParams(query);
  const [from, to] = [Number(words.get("from") ?? NaN), Number(words.get("to") ?? NaN)];
  const block = amount(words, "block");
  return {
    ids: numbers(words.get("ids")).slice(0, MOST_RUNS),
    channel: words.get("channel") ?? FIRST.channel,
    align: ALIGNS.find(({ align }) => align === words.get("align"))?.align ?? FIRST.align,
    block: block === null ? null : Math.floor(block),
    toleranceAbs: amount(words, "abs"),
    toleranceRel: amount(words, "rel"),
    window: from < to ? { from, to } : null,
    hidden: numbers(words.get("hidden")),
    pane: PANES.find((pane) => pane === words.get("pane")) ?? FIRST.pane,
    measurement: words.get("measurement") ?? FIRST.measurement,
  };
}

/** The same as it stands in the address: what is as at first needs no words. */
export function queryOf(compared: Compared): string {
  const { ids, window, hidden } = compared;
  const words: [string, string | null][] = [
    ["channel", compared.channel === FIRST.channel ? null : compared.channel],
    ["align", compared.align === FIRST.align ? null : compared.align],
    ["block", compared.block === null ? null : String(compared.block)],
    ["abs", compared.toleranceAbs === null ? null : String(compared.toleranceAbs)],
    ["rel", compared.toleranceRel === null ? null : String(compared.toleranceRel)],
    ["from", window === null ? null : String(Number(window.from.toFixed(7)))],
    ["to", window === null ? null : String(Number(window.to.toFixed(7)))],
    ["hidden", hidden.length === 0 ? null : hidden.join(",")],
    ["pane", compared.pane === FIRST.pane ? null : compared.pane],
    ["measurement", compared.measurement === FIRST.measurement ? null : compared.measurement],
  ];
  const said = words.filter((word): word is [string, string] => word[1] !== null);
  return [`ids=${ids.join(",")}`, ...said.map(([name, value]) => `${name}=${encodeURIComponent(value)}`)].join("&");
}

/** What the server is asked for. */
export function askedOf(compared: Compared, points: number): string {
  const { window, align } = compared;
  const asked = new URLSearchParams({ ids: compared.ids.join(","), channels: compared.channel, align });
  asked.set("points", String(Math.min(5000, Math.max(200, Math.round(points)))));
  if (align !== "time" && compared.block !== null) asked.set("block", String(compared.block));
  if (align === "block" && compared.block === null) asked.set("block", "0");
  if (compared.toleranceAbs !== null) asked.set("tolerance_abs", String(compared.toleranceAbs));
  if (compared.toleranceRel !== null) asked.set("tolerance_rel", String(compared.toleranceRel));
  if (window !== null && align !== "phase") {
    asked.set("from_s", String(window.from));
    asked.set("to_s", String(window.to));
  }
  return asked.toString();
}

/** With another run as the baseline. */
export const withBaseline = (compared: Compared, id: number): Compared => ({
  ...compared,
  ids: [id, ...compared.ids.filter((other) => other !== id)],
});

/** Without a run; two are left at least. */
export function without(compared: Compared, id: number): Compared {
  if (compared.ids.length <= 2) return compared;
  return {
    ...compared,
    ids: compared.ids.filter((other) => other !== id),
    hidden: compared.hidden.filter((other) => other !== id),
  };
}

/** With a run's curve hidden or shown again. */
export function toggled(compared: Compared, id: number): Compared {
  const { hidden } = compared;
  return { ...compared, hidden: hidden.includes(id) ? hidden.filter((other) => other !== id) : [...hidden, id] };
}
