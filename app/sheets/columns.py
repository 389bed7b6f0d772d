"""Sheets as tables: a column for each quantity, named with its unit, as CSV has them."""

from collections.abc import Iterable

from app.sheets.schemas import CompensatorSheet, Curve, LinearSheet, LoopResponse, StaticSheet

Columns = dict[str, Curve]


def of_static(sheet: StaticSheet) -> Columns:
    """A row for each orifice and valve command."""
    return {
        "orifice_diameter_m": _each(
            (o.orifice_diameter_m, sheet.valve_command) for o in sheet.orifices
        ),
        "valve_command": [x for _ in sheet.orifices for x in sheet.valve_command],
        "load_pressure_pa": _joined(o.load_pressure_pa for o in sheet.orifices),
        "force_n": _joined(o.force_n for o in sheet.orifices),
        "force_gain_n": _joined(o.force_gain_n for o in sheet.orifices),
        "bypass_flow_m3_s": _joined(o.bypass_flow_m3_s for o in sheet.orifices),
    }


def of_loops(sheet: LinearSheet) -> Columns:
    """A row for each amplitude: coefficients and margins, as in the rig's data sheet."""
    loops = sheet.loops
    return {
        "amplitude_n": [loop.amplitude_n for loop in loops],
        "mean_n": [loop.mean_n for loop in loops],
        "k_1_n": [loop.k_1_n for loop in loops],
        "k_2_n_s_m": [loop.k_2_n_s_m for loop in loops],
        "tau_s": [loop.tau_s for loop in loops],
        "crossover_hz": [loop.margins.crossover_hz for loop in loops],
        "phase_margin_deg": [loop.margins.phase_margin_deg for loop in loops],
        "gain_margin_db": [loop.margins.gain_margin_db for loop in loops],
        "worst_sensitivity": [loop.margins.worst_sensitivity for loop in loops],
        "peak_db": [loop.peak.gain_db if loop.peak else None for loop in loops],
        "peak_hz": [loop.peak.frequency_hz if loop.peak else None for loop in loops],
    }


def of_linear(sheet: LinearSheet) -> Columns:
    """A row for each amplitude and frequency: the responses of the loop."""
    loops = sheet.loops
    return {
        "amplitude_n": _each((loop.amplitude_n, sheet.frequencies_hz) for loop in loops),
        "frequency_hz": [f for _ in loops for f in sheet.frequencies_hz],
        "open_loop_gain_db": _joined(loop.open_loop.gain_db for loop in loops),
        "open_loop_phase_deg": _joined(loop.open_loop.phase_deg for loop in loops),
        "closed_loop_gain_db": _joined(loop.closed_loop.gain_db for loop in loops),
        "closed_loop_phase_deg": _joined(loop.closed_loop.phase_deg for loop in loops),
    }


def of_compensator(sheet: CompensatorSheet) -> Columns:
    """A row for each frequency."""
    shown: dict[str, LoopResponse] = {
        "lead": sheet.lead,
        "low_pass": sheet.low_pass,
        "notch": sheet.notch,
        "whole": sheet.whole,
        "compensation": sheet.compensation,
        "loop_with_branch": sheet.with_branch.response,
        "loop_without_branch": sheet.without_branch.response,
    }
    columns: Columns = {"frequency_hz": sheet.frequencies_hz}
    for name, response in shown.items():
        columns[f"{name}_gain_db"] = response.gain_db
        columns[f"{name}_phase_deg"] = response.phase_deg
    return columns | {"disturbance_db": sheet.disturbance_db}


def of_branch(sheet: CompensatorSheet) -> Columns:
    """A row with the branch and one without it; the exact tuning with the former, where it was asked for."""
    margins = [sheet.with_branch.margins, sheet.without_branch.margins]
    columns: Columns = {
        "branch": [1.0, 0.0],
        "crossover_hz": [m.crossover_hz for m in margins],
        "phase_margin_deg": [m.phase_margin_deg for m in margins],
        "gain_margin_db": [m.gain_margin_db for m in margins],
        "worst_sensitivity": [m.worst_sensitivity for m in margins],
    }
    if sheet.tuning is not None:
        columns["exact_at_hz"] = [sheet.tuning.frequency_hz, None]
        columns["exact_ff_v"] = [sheet.tuning.ff_v, None]
        columns["exact_ff_a"] = [sheet.tuning.ff_a, None]
    return columns


def _joined(curves: Iterable[Curve]) -> Curve:
    return [value for curve in curves for value in curve]


def _each(values: Iterable[tuple[float, Curve]]) -> Curve:
    return [value for value, curve in values for _ in curve]
