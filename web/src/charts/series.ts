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

/** What else of a recorded run can be charted. */
export const RUN_CHARTS: readonly ChartInfo[] = [
  ...CHARTS.map((info) => ({ ...info, series: info.series.filter((entry) => !entry.off) })),
  {
    id: "error",
    title: "Force error",
    series: [{ channel: "force_error_n", label: "Error", role: "error" }],
    scale: { centred: true, minSpan: 200 },
  },
  {
    id: "velocity",
    title: "Velocity",
    series: [{ channel: "velocity_m_s", label: "Velocity", role: "measured" }],
    scale: { centred: true, minSpan: 0.01 },
  },
  {
    id: "pressures",
    title: "Pressures",
    series: [
      { channel: "pressure_1_pa", label: "Chamber 1", role: "measured" },
      { channel: "pressure_2_pa", label: "Chamber 2", role: "commanded" },
      { channel: "supply_pressure_pa", label: "Supply", role: "error" },
    ],
    scale: { centred: false, minSpan: 1e5 },
  },
  {
    id: "compensation",
    title: "Compensation",
    series: [
      { channel: "compensation_velocity", label: "Velocity term", role: "measured" },
      { channel: "compensation_acceleration", label: "Acceleration term", role: "commanded" },
    ],
    scale: { centred: true, minSpan: 0.01 },
  },
];
const SHOWN_FIRST: readonly string[] = CHARTS.map(({ id }) => id);

/** Which charts an address shows: those that were seen live where it says nothing. */
export function chartsOf(show: string | null): readonly string[] {
  const wanted = (show ?? "").split(",");
  const known = RUN_CHARTS.map(({ id }) => id).filter((id) => wanted.includes(id));
  return known.length > 0 ? known : SHOWN_FIRST;
}

/** What the address says of them; null where it need not say anything. */
export const showOf = (shown: readonly string[]): string | null =>
  shown.join() === SHOWN_FIRST.join() ? null : shown.join();
