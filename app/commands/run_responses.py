"""`forcerig analyse frequency-response`: every point of a transfer that a run's file tells, without a console."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from rich.table import Table

from app.analysis.response.transfers import EVERY, MOTION_TRANSFERS
from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.commands.printed import Printed, print_csv
from app.commands.run_spectra import Spectral, spectral
from app.conducting.found import Found
from app.conducting.responding import NEEDS, Responding, responds
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.documents.messages import nearest
from app.errors import Code, Refusal
from app.exports.extract import Extract, Wanted, extract
from app.runs.measuring import read_rig
from app.runs.response_loop import LOOP, available_of, loop_margins, loop_points, without_extremes
from app.runs.response_schemas import LoopMargins, ResponsePointOut, ResponseSeries
from app.runs.response_series import series_of

WIDEST = 120  # a table that is cut tells nobody anything


@dataclass(frozen=True)
class Asked:
    """Which transfer: None is that of the force, or the first that the run has. `load_hz` is the open loop's.

    With `spectral` it is found by averaged spectra over the whole record instead.
    """

    transfer: str | None = None
    load_hz: float | None = None
    spectral: Spectral | None = None


class _Read(NamedTuple):
    """A transfer of a run."""

    transfer: str
    series: list[ResponseSeries]
    margins: list[LoopMargins]


def frequency_response(path: Path, asked: Asked, printed: Printed) -> Exit:
    """Print every point of a transfer, and its extremes or margins."""
    refusal = _refused(asked, printed)
    if refusal is None and asked.spectral is not None:
        return spectral(path, asked.transfer or "force", asked.spectral, printed)
    found = refusal or _read(path, asked)
    if isinstance(found, Refusal):
        return print_refusal(found, printed.as_json)
    rows = [_row(series, point) for series in found.series for point in series.points]
    if printed.as_json:
        margins = {"margins": [one.model_dump() for one in found.margins]} if found.margins else {}
        unit = EVERY[found.transfer].unit
        print_json({"transfer": found.transfer, "unit": unit, "points": rows, **margins})
    elif printed.as_csv:
        print_csv(rows)
    else:
        _print_points(found, rows)
    return Exit.PASSED


def _refused(asked: Asked, printed: Printed) -> Refusal | None:
    if printed.as_json and printed.as_csv:
        return Refusal(Code.INVALID_REQUEST, "Either --json or --csv: leave one of them out")
    name = asked.transfer
    if name is not None and name not in EVERY:
        detail = f"There is no transfer '{name}'{nearest(name, EVERY)} Known: {', '.join(EVERY)}"
        return Refusal(Code.INVALID_REQUEST, detail)
    if asked.load_hz is not None and name != LOOP:
        detail = "--load-hz puts the compensation into the open loop: it needs --transfer loop"
        return Refusal(Code.INVALID_REQUEST, detail)
    return None


def _read(path: Path, asked: Asked) -> _Read | Refusal:
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
    points = _points(run, definition)
    there = available_of(points) if points else []
    name = asked.transfer or (there[0] if there else "force")
    if name not in there:
        told = f"it has {', '.join(there)}" if there else "it ended before the first point"
        return Refusal(Code.NO_DATA, f"{path.name} has no point of the transfer '{name}': {told}")
    if name == LOOP:
        controller = run.description["controller"]
        points = loop_points(points, definition, controller, run.period_s, asked.load_hz)
    series = series_of(points, name)
    if name == LOOP:
        return _Read(name, without_extremes(series), loop_margins(series))
    return _Read(name, series, [])


def _points(run: Extract, definition: Definition) -> list[Found]:
    rig = read_rig(run.description.get("rig"))
    responding = Responding(definition, run.period_s, run.origin_tick, rig)
    with progress_bar("Fitting") as progress:
        for chunk in run.chunks(progress, NEEDS):
            responding.take(chunk)
    return responding.points()


def _row(series: ResponseSeries, point: ResponsePointOut) -> dict[str, Any]:
    told = {"method": series.method, "block": series.block, **point.model_dump()}
    return {name: None if _is_no_number(value) else value for name, value in told.items()}


def _is_no_number(value: Any) -> bool:
    return isinstance(value, float) and not math.isfinite(value)


def _print_points(found: _Read, rows: list[dict[str, Any]]) -> None:
    console = text_console()
    console.width = max(console.width, WIDEST)
    transfer = EVERY[found.transfer]
    console.print(f"{transfer.doc}, {transfer.unit}", markup=False)
    amplitude = "mm" if found.transfer in MOTION_TRANSFERS else "N"
    table = Table(
        amplitude, "mean N", "Hz", "gain", "± 95 %", "dB", "°", "± 95 % °", "coherence", "THD %"
    )
    for row in rows:
        table.add_row(*_cells(row))
    console.print(table)
    for text in [*_extremes(found), *_margins(found)]:
        console.print(text, markup=False)


def _cells(row: dict[str, Any]) -> Iterator[str]:
    half_deg = (row["phase_high_deg"] - row["phase_low_deg"]) / 2
    half = None if row["gain_high"] is None else row["gain_high"] - row["gain"]
    names = ("mean_n", "frequency_hz", "gain")
    amplitude_m = row["amplitude_m"]
    amplitude = row["amplitude_n"] if amplitude_m is None else 1e3 * amplitude_m
    values = [amplitude, *(row[name] for name in names)]
    values += [half, row["gain_db"], row["phase_deg"], half_deg]
    for value in [*values, row["coherence"], row["distortion_percent"]]:
        yield "" if value is None else f"{value:,.4g}"


def _extremes(found: _Read) -> Iterator[str]:
    for one in found.series:
        at = one.extremes
        said = [
            f"{name} {extreme.gain_db:+.2f} dB at {extreme.frequency_hz:.1f} Hz"
            for name, extreme in (("peak", at.peak), ("dip", at.dip))
            if extreme is not None
        ]
        said += [
            f"{name} at {hz:.1f} Hz"
            for name, hz in (("−3 dB", at.minus_3_db_hz), ("−90°", at.minus_90_deg_hz))
            if hz is not None
        ]
        if said:
            yield f"{_load(one)}: {', '.join(said)}"


def _margins(found: _Read) -> Iterator[str]:
    for series, one in zip(found.series, found.margins, strict=False):
        said = [
            text.format(value)
            for text, value in (
                ("crossover {:.1f} Hz", one.crossover_hz),
                ("phase margin {:.1f}°", one.phase_margin_deg),
                ("gain margin {:.2f} dB", one.gain_margin_db),
                ("worst sensitivity {:.2f}", one.worst_sensitivity),
            )
            if value is not None
        ]
        yield f"{_load(series)}: {', '.join(said)}"


def _load(series: ResponseSeries) -> str:
    if series.amplitude_m is not None:
        return f"{1e3 * series.amplitude_m:,g} mm on {series.mean_n:,g} N"
    return f"{series.amplitude_n:,g} N on {series.mean_n:,g} N"
