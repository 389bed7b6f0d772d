// The margins of an open loop, measured or modelled, as marks of a Bode chart. Pure.

import { frequencyText, type Extreme } from "../../charts/bode";
import type { LoopMargins } from "./types";

type Margins = Pick<LoopMargins, "crossover_hz" | "phase_margin_deg" | "gain_margin_db" | "turnover_hz">;

/** Where the margins are read off: at the crossover, and where the phase turns over. */
export function marginMarks({ crossover_hz, phase_margin_deg, gain_margin_db, turnover_hz }: Margins): Extreme[] {
  const marks: Extreme[] = [];
  if (crossover_hz !== null && phase_margin_deg !== null)
    marks.push({ frequency_hz: crossover_hz, gain_db: 0, text: `${phase_margin_deg.toFixed(0)}° at ${frequencyText(crossover_hz)}` });
  if (turnover_hz !== null && gain_margin_db !== null)
    marks.push({ frequency_hz: turnover_hz, gain_db: -gain_margin_db, text: `${gain_margin_db.toFixed(1)}\u00a0dB at ${frequencyText(turnover_hz)}` });
  return marks;
}
