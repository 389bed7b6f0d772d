"""`forcerig analyse frequency-response --estimator`: a response by averaged spectra of a whole record."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rich.table import Table

from app.analysis.response.curve import Curve
from app.analysis.response.spectral import Against, spectral_response
from app.analysis.response.stepped import REFERENCE
from app.analysis.response.transfers import MOTION_TRANSFERS, TRANSFERS, Transfer
from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.commands.printed import Printed, print_csv
from app.documents.messages import nearest
from app.errors import Code, Refusal
from app.exports.extract import Extract, Wanted, extract

KNOWN = TRANSFERS | MOTION_TRANSFERS  # those of which input and output are channels
ESTIMATORS = {one.value: one for one in Against}
MOST_TICKS = 14_400_000  # an hour: it is all in memory at once


@dataclass(frozen=True)
class Spectral:
    """Where the noise is thought to be, the length of a segment, and up to which frequency is told."""

    estimator: str
    segment_s: float = 1.0
    to_hz: float = 200.0


def spectral(path: Path, transfer: str, asked: Spectral, printed: Printed) -> Exit:
    """Print a transfer at every multiple of 1/segment."""
    found = _found(path, transfer, asked)
    if isinstance(found, Refusal):
        return print_refusal(found, printed.as_json)
    rows = list(_rows(found, asked.to_hz))
    unit, doc = KNOWN[transfer].unit, KNOWN[transfer].doc
    if printed.as_json:
        told = {"transfer": transfer, "unit": unit, "estimator": asked.estimator, "points": rows}
        print_json(told)
    elif printed.as_csv:
        print_csv(rows)
    else:
        text_console().print(f"{doc}, {unit}, by {asked.estimator}", markup=False)
        text_console().print(_table(rows))
    return Exit.PASSED


def _found(path: Path, transfer: str, asked: Spectral) -> Curve | Refusal:
    against, asks = ESTIMATORS.get(asked.estimator), KNOWN.get(transfer)
    if against is None:
        return _unknown("estimator", asked.estimator, ESTIMATORS)
    if asks is None:
        return _unknown("transfer by averaged spectra", transfer, KNOWN)
    if against is Against.REFERENCE and asks.input == REFERENCE:
        detail = f"The setpoint is the input of '{transfer}' itself: --estimator h1 is the same"
        return Refusal(Code.INVALID_REQUEST, detail)
    columns = _columns(path, asks)
    if isinstance(columns, Refusal):
        return columns
    run, signals = columns
    reference = signals[REFERENCE] if against is Against.REFERENCE else None
    ticks = round(asked.segment_s / run.period_s)
    pair = signals[asks.input], signals[asks.output]
    if min(np.ptp(one) for one in pair) == 0.0:
        detail = f"{path.name}: {asks.input} or {asks.output} stands still, so it has no response"
        return Refusal(Code.NO_DATA, detail)
    try:
        return spectral_response(*pair, run.period_s, ticks, against, reference=reference)
    except ValueError as error:
        return Refusal(Code.INVALID_REQUEST, f"{path.name}: {error}: choose a shorter --segment-s")


def _columns(
    path: Path, transfer: Transfer
) -> tuple[Extract, dict[str, npt.NDArray[np.float32]]] | Refusal:
    names = tuple(dict.fromkeys([transfer.input, transfer.output, REFERENCE]))
    run = extract(path, Wanted(names))
    if isinstance(run, Refusal):
        return run
    if run.ticks > MOST_TICKS:
        detail = f"{path.name} is longer than an hour: export a part of it, and take that"
        return Refusal(Code.INVALID_REQUEST, detail)
    with progress_bar("Reading") as progress:
        chunks = [{n: np.asarray(c[n]) for n in ("tick", *names)} for c in run.chunks(progress)]
    signals = {name: np.concatenate([chunk[name] for chunk in chunks]) for name in names}
    at = np.concatenate([chunk["tick"] for chunk in chunks])
    if len(at) != run.ticks or not all(np.isfinite(one).all() for one in signals.values()):
        detail = f"{path.name} has gaps or values that are no numbers: export a part without them"
        return Refusal(Code.NO_DATA, detail)
    return run, signals


def _rows(curve: Curve, to_hz: float) -> Iterator[dict[str, Any]]:
    gain_95, phase_95_deg = curve.gain_95, curve.phase_95_deg
    for i in np.flatnonzero(curve.frequencies_hz <= to_hz * (1 + 1e-9)):
        gain = complex(curve.gain[i])
        yield {
            "frequency_hz": float(curve.frequencies_hz[i]),
            "gain": _finite(abs(gain)),
            "phase_deg": _finite(math.degrees(math.atan2(gain.imag, gain.real))),
            "gain_low": _finite(gain_95[i][0]),
            "gain_high": _finite(gain_95[i][1]),
            "phase_low_deg": _finite(phase_95_deg[i][0]),
            "phase_high_deg": _finite(phase_95_deg[i][1]),
            "coherence": _finite(curve.coherence[i]),
        }


def _table(rows: list[dict[str, Any]]) -> Table:
    table = Table("Hz", "gain", "95 %", "°", "95 % °", "coherence")
    for row in rows:
        told = {name: "" if v is None else f"{v:,.4g}" for name, v in row.items()}
        gain = f"{told['gain_low']} … {told['gain_high']}"
        phase = f"{told['phase_low_deg']} … {told['phase_high_deg']}"
        table.add_row(
            told["frequency_hz"], told["gain"], gain, told["phase_deg"], phase, told["coherence"]
        )
    return table


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _unknown(what: str, name: str, known: Mapping[str, object]) -> Refusal:
    detail = f"There is no {what} '{name}'{nearest(name, known)} Known: {', '.join(known)}"
    return Refusal(Code.INVALID_REQUEST, detail)
