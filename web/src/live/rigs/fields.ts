// Every value of the rig configuration: its place in the document, what it is called, its unit, its meaning. Pure.

import type { Configuration } from "./types";

export type Kind = "number" | "text" | "date";

export interface Field {
  /** As the server writes it: `model.structure.k_pl`. */
  readonly path: string;
  readonly label: string;
  readonly unit: string;
  readonly hint: string;
  readonly kind: Kind;
  /** May be left empty. */
  readonly optional: boolean;
}

export interface Group {
  readonly title: string;
  readonly fields: readonly Field[];
}

type Row = readonly [name: string, label: string, unit: string, hint?: string];

const numbers = (below: string, rows: readonly Row[]): Field[] =>
  rows.map(([name, label, unit, hint = ""]) => ({ path: `${below}.${name}`, label, unit, hint, kind: "number", optional: false }));
const words = (below: string, rows: readonly (readonly [string, string])[]): Field[] =>
  rows.map(([name, label]) => ({ path: `${below}.${name}`, label, unit: "", hint: "", kind: "text", optional: true }));

const PLATE = [
  ["name", "Name"],
  ["maker", "Maker"],
  ["part_number", "Part number"],
  ["serial_number", "Serial number"],
  ["notes", "Notes"],
] as const;

export const ITEMS: readonly Group[] = [
  {
    title: "Rig",
    fields: [
      { path: "lab", label: "Laboratory", unit: "", hint: "On the reports", kind: "text", optional: true },
      ...words("rig", PLATE),
    ],
  },
  { title: "Unit under test", fields: words("unit_under_test", PLATE) },
  {
    title: "Limits of this lab",
    fields: [
      { path: "limits.force_n", label: "Force", unit: "N", hint: "What tests may ask for; empty: what the rig can do", kind: "number", optional: true },
      { path: "limits.displacement_m", label: "Displacement", unit: "m", hint: "What tests may ask for; empty: what the rig can do", kind: "number", optional: true },
    ],
  },
];

/** The sensors by their names in the document, and the unit that they measure in. */
export const SENSORS: readonly (readonly [name: string, label: string, unit: string])[] = [
  ["load_cell", "Load cell", "N"],
  ["lvt", "LVT", "m/s"],
  ["lvdt", "LVDT", "m"],
  ["pressure_1", "Pressure, chamber 1", "Pa"],
  ["pressure_2", "Pressure, chamber 2", "Pa"],
  ["supply_pressure", "Supply pressure", "Pa"],
];

export const calibrationFields = (sensor: string, unit: string): readonly Field[] => {
  const below = `calibrations.${sensor}`;
  return [
    ...words(below, PLATE.slice(1, 4)),
    ...numbers(below, [
      ["gain", "Gain", `${unit}/V`],
      ["offset", "Offset", unit, "At 0 V"],
    ]),
    { path: `${below}.class_percent`, label: "Class", unit: "%", hint: "Of full scale", kind: "number", optional: true },
    { path: `${below}.calibrated_on`, label: "Calibrated on", unit: "", hint: "", kind: "date", optional: true },
    { path: `${below}.due_on`, label: "Due on", unit: "", hint: "", kind: "date", optional: true },
    ...words(below, [["certificate", "Certificate"]]),
  ];
};

export const MODEL: readonly Group[] = [
  {
    title: "Load actuator",
    fields: numbers("model.load_actuator", [
      ["area_m2", "Piston area A", "m²"],
      ["volume_1_m3", "Volume, chamber 1", "m³", "At mid stroke"],
      ["volume_2_m3", "Volume, chamber 2", "m³", "At mid stroke"],
      ["bypass_diameter_m", "Bypass diameter d_O", "m"],
      ["bypass_discharge", "Bypass discharge C_dO", ""],
      ["bypass_transition_reynolds", "Bypass transition Re", ""],
      ["bypass_linear_m3_s_pa", "Linear bypass", "m³/(s Pa)", "Beside the orifice"],
      ["leak_m3_s_pa", "Leak across piston", "m³/(s Pa)"],
      ["drain_1_m3_s_pa", "Drain, chamber 1", "m³/(s Pa)"],
      ["drain_2_m3_s_pa", "Drain, chamber 2", "m³/(s Pa)"],
      ["drain_pa", "Drain pressure", "Pa"],
      ["coulomb_n", "Coulomb friction", "N"],
      ["coulomb_m_s", "Friction turns over", "m/s"],
      ["viscous_n_s_m", "Viscous friction", "N s/m"],
      ["end_cap_share", "End cap at", "", "Share of the smaller chamber left"],
      ["end_stop_n_m", "End stop stiffness", "N/m"],
      ["end_stop_s_m", "End stop damping", "s/m"],
    ]),
  },
  {
    title: "Structure",
    fields: numbers("model.structure", [
      ["m_b_kg", "m_B, body", "kg"],
      ["m_la_kg", "m_LA, rod", "kg"],
      ["m_1_kg", "m_1", "kg"],
      ["m_2_kg", "m_2", "kg"],
      ["k_pl", "k_Pl, frame plate", "N/m"],
      ["c_pl", "c_Pl", "N s/m"],
      ["k_lc", "k_LC, load cell", "N/m"],
      ["c_lc", "c_LC", "N s/m"],
      ["k_2", "k_2, fixture", "N/m"],
      ["c_2", "c_2", "N s/m"],
    ]),
  },
  {
    title: "Unit under test",
    fields: numbers("model.unit", [
      ["k_tra", "k_TRA", "N/m"],
      ["c_tra", "c_TRA", "N s/m"],
      ["omega_t_rad_s", "Servo ω_T", "rad/s"],
      ["zeta_t", "Servo ζ_T", ""],
      ["rate_m_s", "Rate limit", "m/s"],
      ["stroke_m", "Half stroke", "m"],
    ]),
  },
  {
    title: "Servovalve",
    fields: numbers("model.servovalve", [
      ["omega_f_rad_s", "First stage ω_f", "rad/s"],
      ["zeta_f", "First stage ζ_f", ""],
      ["flapper_stop_k", "Flapper stop, stiffness", ""],
      ["flapper_stop_c", "Flapper stop, damping", ""],
      ["spool_gain_rad_s", "Spool loop K_sp", "rad/s"],
      ["spool_rate_m_s", "Spool rate", "m/s"],
      ["spool_stroke_m", "Spool half stroke", "m"],
      ["spool_stop_1_s", "Spool stop", "1/s"],
      ["null_m", "Null offset", "m"],
      ["window_m", "Window of a land w", "m"],
      ["discharge", "Discharge C_d", ""],
      ["transition_reynolds", "Transition Re", ""],
      ["clearance_m", "Radial clearance", "m"],
      ["underlap_pa_m", "Underlap P–A", "m", "Negative: overlap"],
      ["underlap_at_m", "Underlap A–T", "m", "Negative: overlap"],
      ["underlap_pb_m", "Underlap P–B", "m", "Negative: overlap"],
      ["underlap_bt_m", "Underlap B–T", "m", "Negative: overlap"],
    ]),
  },
  {
    title: "Supply",
    fields: numbers("model.supply", [
      ["high_pa", "High pressure", "Pa"],
      ["low_pa", "Low pressure", "Pa"],
      ["ramp_pa_s", "Ramp", "Pa/s"],
      ["tank_pa", "Tank", "Pa"],
      ["relief_pa", "Relief valve cracks", "Pa"],
      ["relief_m3_s_pa", "Relief valve gain", "m³/(s Pa)"],
      ["bleed_m3_s", "Bleed flow", "m³/s", "At high pressure"],
      ["line_supply_k", "Supply line, quadratic", "Pa/(m³/s)²"],
      ["line_return_k", "Return line, quadratic", "Pa/(m³/s)²"],
      ["line_supply_r", "Supply line, laminar", "Pa/(m³/s)"],
      ["line_return_r", "Return line, laminar", "Pa/(m³/s)"],
      ["hose_m3_pa", "Elasticity of hoses", "m³/Pa"],
      ["accumulator_supply_m3", "Supply accumulator", "m³"],
      ["precharge_supply_pa", "Supply precharge", "Pa"],
      ["accumulator_return_m3", "Return accumulator", "m³"],
      ["precharge_return_pa", "Return precharge", "Pa"],
      ["accumulator_n", "Polytropic exponent", ""],
    ]),
  },
  {
    title: "Fluid",
    fields: numbers("model.fluid", [
      ["temperature_c", "Temperature", "°C"],
      ["reference_pa", "Reference pressure", "Pa"],
      ["density_kg_m3", "Density", "kg/m³"],
      ["bulk_modulus_pa", "Bulk modulus", "Pa"],
      ["bulk_modulus_slope", "Its slope dβ/dp", ""],
      ["viscosity_m2_s", "Viscosity", "m²/s"],
      ["free_air", "Free air", "", "Share of the volume"],
      ["air_n", "Polytropic exponent of air", ""],
    ]),
  },
  {
    title: "Sensors",
    fields: numbers("model.sensors", [
      ["omega_lc_rad_s", "Load cell ω", "rad/s"],
      ["zeta_lc", "Load cell ζ", ""],
      ["omega_lvt_rad_s", "LVT ω", "rad/s"],
      ["force_noise_n", "Noise of force", "N", "1 σ"],
      ["velocity_noise_m_s", "Noise of velocity", "m/s", "1 σ"],
      ["force_range_n", "Range of force", "N"],
      ["velocity_range_m_s", "Range of velocity", "m/s"],
      ["displacement_range_m", "Range of displacement", "m"],
      ["pressure_range_pa", "Range of pressure", "Pa"],
      ["bits", "Converter", "bit"],
    ]),
  },
];

const ALL: readonly Field[] = [
  ...ITEMS.flatMap(({ fields }) => fields),
  ...SENSORS.flatMap(([sensor, label, unit]) =>
    calibrationFields(sensor, unit).map((field) => ({ ...field, label: `${label}, ${field.label.toLowerCase()}` })),
  ),
  ...MODEL.flatMap(({ title, fields }) => fields.map((field) => ({ ...field, label: `${title}, ${field.label}` }))),
];

export type Value = number | string | null;

export function valueAt(document: Configuration, path: string): Value {
  let found: unknown = document;
  for (const name of path.split(".")) found = (found as Record<string, unknown> | null | undefined)?.[name];
  return typeof found === "number" || typeof found === "string" ? found : null;
}

/** The configuration with one value changed; all else is the same object. */
export function withValue(document: Configuration, path: string, value: Value): Configuration {
  return set(document as unknown as Record<string, unknown>, path.split("."), value) as unknown as Configuration;
}

function set(within: Record<string, unknown>, [name = "", ...below]: readonly string[], value: Value): Record<string, unknown> {
  const inner = below.length === 0 ? value : set((within[name] ?? {}) as Record<string, unknown>, below, value);
  return { ...within, [name]: inner };
}

export interface Changed {
  readonly field: Field;
  readonly before: Value;
  readonly after: Value;
}

export const changesBetween = (before: Configuration, after: Configuration): readonly Changed[] =>
  ALL.flatMap((field) => {
    const [was, is] = [valueAt(before, field.path), valueAt(after, field.path)];
    return was === is ? [] : [{ field, before: was, after: is }];
  });

/** What a change on the server's list is called. */
export const labelOf = (path: string): string => ALL.find((field) => field.path === path)?.label ?? path;

/** What somebody typed, as the field holds it; undefined where it is no figure. */
export function read(field: Field, text: string): Value | undefined {
  const plain = text.trim().replace("\u2212", "-");
  if (plain === "") return field.kind === "text" ? "" : field.optional ? null : undefined;
  if (field.kind !== "number") return plain;
  return Number.isFinite(Number(plain)) ? Number(plain) : undefined;
}
