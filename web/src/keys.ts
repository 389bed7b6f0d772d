// Which key does what. Pure: the page says where the focus is.

import { COMMANDS } from "./live/operate";
import type { Command } from "./live/types";

type KeyOfView =
  | ("help" | "theme" | "control")
  | ("operate" | "tests" | "runs" | "interlocks" | "controller" | "rig" | "drills" | "system")
  | ("acknowledge" | "pause" | "shorter" | "longer" | "stage");

export type KeyAction =
  | { readonly kind: "stop" }
  | { readonly kind: "leave-field" }
  | { readonly kind: "command"; readonly command: Exclude<Command, "stop"> }
  | { readonly kind: KeyOfView };

export interface KeyInfo {
  readonly key: string;
  readonly does: string;
  readonly action: KeyAction;
}

/** Keys of the view. Those of commands are in `COMMANDS`. */
export const VIEW_KEYS: readonly KeyInfo[] = [
  { key: "c", does: "Command of the rig: take, ask for, release", action: { kind: "control" } },
  { key: "a", does: "Acknowledge trips", action: { kind: "acknowledge" } },
  { key: "f", does: "Freeze or run the charts", action: { kind: "pause" } },
  { key: "+", does: "Shorter chart window", action: { kind: "shorter" } },
  { key: "-", does: "Longer chart window", action: { kind: "longer" } },
  { key: "v", does: "Prediction or outcome instead of charts, and back", action: { kind: "stage" } },
  { key: "1", does: "Operate", action: { kind: "operate" } },
  { key: "2", does: "Tests", action: { kind: "tests" } },
  { key: "3", does: "Runs", action: { kind: "runs" } },
  { key: "4", does: "Interlocks", action: { kind: "interlocks" } },
  { key: "5", does: "Controller", action: { kind: "controller" } },
  { key: "6", does: "Rig", action: { kind: "rig" } },
  { key: "7", does: "Drills", action: { kind: "drills" } },
  { key: "8", does: "System", action: { kind: "system" } },
  { key: "t", does: "Theme: auto, light, dark", action: { kind: "theme" } },
  { key: "?", does: "Show or hide these keys", action: { kind: "help" } },
];

/** Keys of the pages of runs, for the help, like those of the Tests page. */
export const RUN_KEYS: readonly { readonly key: string; readonly does: string }[] = [
  { key: "/", does: "Search the runs" },
  { key: "↑ ↓", does: "Next or previous run; more are read at the end" },
  { key: "Enter", does: "Open the run" },
  { key: "e", does: "Edit tags, notes and operator" },
  { key: "x", does: "Choose the run for a comparison, or not" },
  { key: "m", does: "Compare the runs that are chosen" },
  { key: "+ −", does: "Zoom in or out, in the chart of a run" },
  { key: "← →", does: "Move along the run; with Shift: by a whole window" },
  { key: "0", does: "The whole run" },
];

/** Keys of the Tests page, for the help. The page itself listens: they mean nothing elsewhere. */
export const TEST_KEYS: readonly { readonly key: string; readonly does: string }[] = [
  { key: "/", does: "Search the tests" },
  { key: "n", does: "New test" },
  { key: "↑ ↓", does: "Next or previous test or block; Enter opens it" },
  { key: "Alt ↑ ↓", does: "Move the block" },
  { key: "Ctrl D", does: "Duplicate the block" },
  { key: "Del", does: "Remove the block" },
  { key: "Ctrl Z", does: "Undo; with Shift: redo" },
  { key: "Ctrl S", does: "Save the test" },
];

/** Keys of the Interlocks page while its table is being changed, for the help. */
export const INTERLOCK_KEYS: readonly { readonly key: string; readonly does: string }[] = [
  { key: "Alt ↑ ↓", does: "Move the detector" },
  { key: "Ctrl D", does: "Duplicate the detector" },
  { key: "Ctrl Z", does: "Undo; with Shift: redo" },
  { key: "Ctrl S", does: "To the reason, and from there: put it in force" },
];

const SINGLE: ReadonlyMap<string, KeyAction> = new Map([
  ...VIEW_KEYS.map(({ key, action }) => [key, action] as const),
  ...COMMANDS.map(({ key, command }) => [key, { kind: "command", command } as KeyAction] as const),
]);

/** Nobody gives a command by a key without seeing what it will act on. Stop is not among these. */
export const ONLY_OPERATING: ReadonlySet<KeyAction["kind"]> = new Set([
  "command",
  "pause",
  "shorter",
  "longer",
  "stage",
]);

export interface Press {
  readonly key: string;
  readonly repeat: boolean;
  /** Control, Alt or Meta is down: the key belongs to the browser. */
  readonly modified: boolean;
  /** The focus is where text is typed. */
  readonly typing: boolean;
  /** The Operate page is on the screen. */
  readonly operating: boolean;
  /** Single keys can be turned off (WCAG 2.1.4); Escape cannot. */
  readonly singleKeys: boolean;
}

/** What a key press means; null where it means nothing here. */
export function actionOf({ key, repeat, modified, typing, operating, singleKeys }: Press): KeyAction | null {
  if (repeat || modified) return null;
  if (key === "Escape") return typing ? { kind: "leave-field" } : { kind: "stop" };
  if (typing || !singleKeys) return null;
  const action = SINGLE.get(key.length === 1 ? key.toLowerCase() : key) ?? null;
  return action !== null && ONLY_OPERATING.has(action.kind) && !operating ? null : action;
}

const TEXT_INPUTS = new Set([
  "text",
  "search",
  "number",
  "email",
  "password",
  "tel",
  "url",
  "date",
  "time",
  "datetime-local",
]);

/** Whether typing goes into this element. A ticked box or a radio button is no text field. */
export function takesText(
  element: { tagName: string; type?: string; isContentEditable?: boolean } | null,
): boolean {
  if (element === null) return false;
  if (element.isContentEditable || element.tagName === "TEXTAREA" || element.tagName === "SELECT")
    return true;
  return element.tagName === "INPUT" && TEXT_INPUTS.has(element.type ?? "text");
}
