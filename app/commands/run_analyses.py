"""`forcerig analyse frequency-response|goodness`: what a run's file tells, without a console."""

import csv
import math
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rich.table import Table

from app.analysis.goodness import goodness_of_fit
from app.analysis.response.extremes import find_extremes
from app.analysis.response.transfers import MOTION_TRANSFERS, TRANSFERS
from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.conducting.found import Found
from app.conducting.responding import NEEDS, Responding, responds
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.documents.messages import nearest
from app.errors import Code, Refusal
from app.exports.extract import Extract, Wanted, extract

HEADINGS = ("N", "mean N", "Hz", "gain", "± of 95 %", "dB", "°", "± of 95 %", "coherence", "THD %")
KNOWN = TRANSFERS | MOTION_TRANSFERS  # those that need no model of the rig
WIDEST = 120  # a table that is cut tells nobody anything
CHANNELS = ("force_n", "force_command_n", "program_tick")


@dataclass(frozen=True)
class Printed:
    """How a result is printed: a table for people where neither is asked for."""

    as_json: bool = False
    as_csv: bool = False


def frequency_response(path: Path, transfer: str, printed: Printed) -> Exit:
    """Print every point of a transfer, and its extremes."""
    if printed.as_json and printed.as_csv:
        detail = "Either --json or --csv: leave one of them out"
        return print_refusal(Refusal(Code.INVALID_REQUEST, detail), printed.as_json)
    if transfer not in KNOWN:
        known = ", ".join(KNOWN)
        detail = f"There is no transfer '{transfer}'{nearest(transfer, KNOWN)} Known: {known}"
        return print_refusal(Refusal(Code.INVALID_REQUEST, detail), printed.as_json)
    found = _points(path)
    if isinstance(found, Refusal):
        return print_refusal(found, printed.as_json)
    rows = [_row(one) for one in found if one.point.transfer == transfer]
    if printed.as_json:
        print_json({"transfer": transfer, "unit": KNOWN[transfer].unit, "points": rows})
    elif printed.as_csv:
        _print_csv(rows)
    else:
        _print_points(transfer, rows)
    return Exit.PASSED


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


def _points(path: Path) -> list[Found] | Refusal:
    run = extract(path, Wanted())
    if isinstance(run, Refusal):
        return run
    definition = definition_from(dict(run.description["definition"]))
    if not isinstance(definition, Definition):
        return definition
    if not responds(definition):
        detail = (
            f"{path.name}: its test has no frequency_response, no sweep and no motion multisine"
        )
        return Refusal(Code.INVALID_REQUEST, detail)
    responding = Responding(definition, run.period_s, run.origin_tick)
    with progress_bar("Fitting") as progress:
        for chunk in run.chunks(progress, NEEDS):
            responding.take(chunk)
    return responding.points()


def _row(found: Found) -> dict[str, Any]:
    point = found.point
    has_db = KNOWN[point.transfer].unit == "1" and point.gain > 0
    return {
        "method": found.method,
        "block": point.block,
        "amplitude_n": point.amplitude_n,
        "amplitude_m": found.amplitude_m,
        "mean_n": point.mean_n,
        "frequency_hz": point.frequency_hz,
        "gain": _finite(point.gain),
        "gain_db": 20 * math.log10(point.gain) if has_db else None,
        "phase_deg": _finite(point.phase_deg),
        "gain_low": _finite(point.gain_95.low),
        "gain_high": _finite(point.gain_95.high),
        "phase_low_deg": _finite(point.phase_95_deg.low),
        "phase_high_deg": _finite(point.phase_95_deg.high),
        "coherence": _finite(point.coherence),
        "distortion_percent": point.distortion_percent,
        "noise_std": found.noise_std,
        "nonlinear_std": found.nonlinear_std,
        "cycles": point.cycles,
        "settled": point.settled,
    }


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


def _print_csv(rows: list[dict[str, Any]]) -> None:
    if rows:
        writer = csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def _print_points(transfer: str, rows: list[dict[str, Any]]) -> None:
    console = text_console()
    console.width = max(console.width, WIDEST)
    console.print(f"{KNOWN[transfer].doc}, {KNOWN[transfer].unit}", markup=False)
    amplitude = "mm" if transfer in MOTION_TRANSFERS else "N"
    table = Table(
        amplitude, "mean N", "Hz", "gain", "± 95 %", "dB", "°", "± 95 % °", "coherence", "THD %"
    )
    for row in rows:
        table.add_row(*_cells(row))
    console.print(table)
    for text in _extremes(transfer, rows):
        console.print(text, markup=False)


def _cells(row: dict[str, Any]) -> Iterator[str]:
    half_deg = (row["phase_high_deg"] - row["phase_low_deg"]) / 2
    half = None if row["gain_high"] is None else row["gain_high"] - row["gain"]
    names = ("mean_n", "frequency_hz", "gain")
    values = [_amplitude(row), *(row[name] for name in names)]
    values += [half, row["gain_db"], row["phase_deg"], half_deg]
    for value in [*values, row["coherence"], row["distortion_percent"]]:
        yield "" if value is None else f"{value:,.4g}"


def _amplitude(row: dict[str, Any]) -> float:
    """Of the force in N, or of the motion in mm."""
    amplitude_m = row["amplitude_m"]
    return float(row["amplitude_n"] if amplitude_m is None else 1e3 * amplitude_m)


def _extremes(transfer: str, rows: list[dict[str, Any]]) -> Iterator[str]:
    if KNOWN[transfer].unit != "1":
        return
    unit = "mm" if transfer in MOTION_TRANSFERS else "N"
    for load in dict.fromkeys((_amplitude(row), row["mean_n"]) for row in rows):
        here = [row for row in rows if (_amplitude(row), row["mean_n"]) == load]
        gain = np.array([row["gain"] for row in here])
        turned = np.exp(1j * np.radians([row["phase_deg"] for row in here]))
        found = find_extremes([row["frequency_hz"] for row in here], gain * turned)
        said = [
            f"{name} {extreme.gain_db:+.2f} dB at {extreme.frequency_hz:.1f} Hz"
            for name, extreme in (("peak", found.peak), ("dip", found.dip))
            if extreme is not None
        ]
        said += [
            f"{name} at {at:.1f} Hz"
            for name, at in (("−3 dB", found.minus_3_db_hz), ("−90°", found.minus_90_deg_hz))
            if at is not None
        ]
        if said:
            yield f"{load[0]:,g} {unit} on {load[1]:,g} N: {', '.join(said)}"
