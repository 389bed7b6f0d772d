// Which channels share a live chart. Measured is drawn in ink, commanded in the colour of commands, on every page.

import type { ChannelName } from "../gen/channels";
import type { ScaleOptions } from "./scale";

export type Role = "measured" | "commanded" | "error";

export interface SeriesInfo {
  readonly channel: ChannelName;
  readonly label: string;
  readonly role: Role;
  readonly off?: boolean;
}

export interface ChartInfo {
  readonly id: string;
  readonly title: string;
  readonly series: readonly SeriesInfo[];
  readonly scale: ScaleOptions;
}

/** Commanded first: what is measured is drawn over it. */
export const CHARTS: readonly ChartInfo[] = [
  {
    id: "force",
    title: "Force",
    series: [
      { channel: "force_command_n", label: "Setpoint", role: "commanded" },
      { channel: "force_n", label: "Force", role: "measured" },
      { channel: "force_error_n", label: "Error", role: "error", off: true },
    ],
    scale: { centred: true, minSpan: 400 },
  },
  {
    id: "displacement",
    title: "Displacement",
    series: [
      { channel: "displacement_command_m", label: "Command", role: "commanded" },
      { channel: "displacement_m", label: "Displacement", role: "measured" },
    ],
    scale: { centred: false, minSpan: 2e-4 },
  },
  {
    id: "valve",
    title: "Valve",
    series: [
      { channel: "valve_command", label: "Command", role: "commanded" },
      { channel: "spool_position", label: "Spool", role: "measured" },
    ],
    scale: { centred: true, minSpan: 0.04 },
  },
];

const CSS: Record<Role, string> = { measured: "--measured", commanded: "--setpoint", error: "--error" };

/** The CSS variable that holds the colour of a role. */
export const colourOf = (role: Role): string => CSS[role];
