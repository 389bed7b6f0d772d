"""`forcerig analyse goodness|unit`: what a run's file tells, without a console."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rich.table import Table

from app.analysis.goodness import goodness_of_fit
from app.analysis.slow_reader import LEAST_CYCLES, SLOW_HZ, SlowReader
from app.analysis.walk import NEEDED, Walk
from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.definitions.windows import stretches
from app.errors import Code, Refusal
from app.exports.extract import Extract, Wanted, extract
from app.run_analysis.schemas import UnitOut
from app.run_analysis.told import unit_out
from app.runs.measuring import read_rig

CHANNELS = ("force_n", "force_command_n", "program_tick")


def goodness(path: Path, against: Path | None, as_json: bool) -> Exit:
    """Print G of the force against that of another run of the same test, or against the setpoint."""
    run = extract(path, Wanted(CHANNELS))
    other = run if against is None else extract(against, Wanted(CHANNELS))
    if isinstance(run, Refusal):
        return print_refusal(run, as_json)
    if isinstance(other, Refusal):
        return print_refusal(other, as_json)
    measured = _by_position(run, "force_n")
    expected = _by_position(other, "force_command_n" if against is None else "force_n")
    ticks = min(len(measured), len(expected))
    both = ~(np.isnan(measured[:ticks]) | np.isnan(expected[:ticks]))
    if not both.any():
        detail = "These runs have no tick of their program in common"
        return print_refusal(Refusal(Code.INVALID_REQUEST, detail), as_json)
    force, reference = measured[:ticks][both], expected[:ticks][both]
    left = force.astype(np.float64) - reference
    told = {
        "goodness_of_fit_percent": _finite(goodness_of_fit(force, reference)),
        "against": "setpoint" if against is None else against.name,
        "ticks": int(both.sum()),
        "error_rms_n": float(np.sqrt(np.mean(left**2))),
        "error_peak_n": float(np.max(np.abs(left))),
    }
    if as_json:
        print_json(told)
    else:
        table = Table("", "")
        for name, value in told.items():
            table.add_row(name, f"{value:,.6g}" if isinstance(value, float) else f"{value}")
        text_console().print(table)
    return Exit.PASSED


def unit(path: Path, as_json: bool) -> Exit:
    """Print stiffness, hysteresis and backlash of the unit under test from the slow cycles of a run."""
    found = _slow(path)
    if isinstance(found, Refusal):
        return print_refusal(found, as_json)
    told = [one.model_dump() for one in found]
    if as_json:
        print_json({"unit": told})
        return Exit.PASSED
    table = Table(
        "block", "N", "Hz", "cycles", "kN/mm", "± σ", "hysteresis J", "± σ", "backlash µm"
    )
    for one in found:
        values: list[float | None] = [one.asked.amplitude_n, one.asked.frequency_hz, one.cycles]
        values += [_times(1e-6, one.stiffness_n_m), _times(1e-6, one.stiffness_std_n_m)]
        values += [one.hysteresis_j, one.hysteresis_std_j, _times(1e6, one.backlash_m)]
        cells = ("" if value is None else f"{value:,.4g}" for value in values)
        table.add_row(str(one.block + 1), *cells)
    text_console().print(table)
    return Exit.PASSED


def _slow(path: Path) -> list[UnitOut] | Refusal:
    run = extract(path, Wanted())
    if isinstance(run, Refusal):
        return run
    definition = definition_from(dict(run.description["definition"]))
    rig = read_rig(run.description.get("rig"))
    if not isinstance(definition, Definition):
        return definition
    if rig is None:
        return Refusal(Code.NO_DATA, f"{path.name} does not say with which rig it was made")
    reader = SlowReader(run.period_s, rig)
    walk = Walk(stretches(definition), run.period_s, run.origin_tick)
    with progress_bar("Reading") as progress:
        for chunk in run.chunks(progress, NEEDED):
            for part in walk.take(chunk):
                reader.take(part)
    found = [unit_out(one) for one in reader.result()]
    detail = (
        f"{path.name} has no slow cycles: a sine of at most {SLOW_HZ:g} Hz is needed that pushes and"
        f" pulls, of {LEAST_CYCLES} whole cycles or more"
    )
    return found or Refusal(Code.NO_DATA, detail)


def _times(scale: float, value: float | None) -> float | None:
    return None if value is None else scale * value


def _by_position(run: Extract, name: str) -> npt.NDArray[np.float32]:
    """A channel by the tick of the program, NaN where it was not played; older runs count ticks."""
    parts: list[tuple[npt.NDArray[Any], npt.NDArray[Any]]] = []
    with progress_bar(f"Reading {run.path.name}") as progress:
        for chunk in run.chunks(progress, [name, "program_tick"]):
            at = chunk["program_tick"]
            if (at < 0).all():
                at = chunk["tick"] - run.origin_tick
            keep = at >= 0
            parts.append((at[keep], np.asarray(chunk[name])[keep]))
    size = max((int(at.max()) + 1 for at, _ in parts if len(at)), default=0)
    found = np.full(size, np.nan, np.float32)
    for at, values in parts:
        found[at] = values
    return found


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
