"""Frequency responses: a Bode figure a transfer, its extremes, and the points of the closed loop."""

from collections.abc import Iterator

import numpy as np

from app.analysis.response.transfers import EVERY
from app.reports.figures.bode import Bode, Corridor, Marked, Response, bode_figure
from app.reports.numbers import NOTHING, digits, quantity
from app.reports.report import Column, Figure, Item, Row, Section, Table
from app.reports.subject import Subject
from app.runs.response_schemas import LoopMargins, ModelCurve, ResponseOut, ResponseSeries

MOST_ROWS = 120
LEAST_GAIN, STILL = 1e-30, 1e-20
WIDE_DB = 60.0  # an interval that reaches farther says nothing


def response(subject: Subject) -> Section | None:
    """Nothing where the test measures none."""
    if subject.found is None:
        return None
    told = [found for found in subject.found.responses if _moves(found)]
    items = [item for found in told for item in _of_transfer(found)]
    return Section("Frequency response", tuple(items)) if items else None


def _moves(found: ResponseOut) -> bool:
    """Whether there is anything in it: a unit that stands still has no response."""
    return any(p.gain > STILL for series in found.series for p in series.points)


def _of_transfer(found: ResponseOut) -> Iterator[Item]:
    doc = EVERY[found.transfer].doc
    yield Figure(doc, bode_figure(_bode(found)), f"Bode diagram. {doc}")
    if found.margins:
        yield _margins(found)
    elif found.unit == "1":
        yield _extremes(found)
    if found.transfer == "force":
        yield _points(found)


def _bode(found: ResponseOut) -> Bode:
    in_unit = "" if found.unit == "1" else f" re 1 {found.unit}"
    models = [_model(curve, first=i == 0) for i, curve in enumerate(found.model)]
    measured = [_series(series) for series in found.series]
    corridors = [Corridor(b.from_hz, b.to_hz, b.low_db, b.high_db) for b in found.bands]
    return Bode(measured + models, list(_marked(found)), corridors, f"Gain (dB{in_unit})")


def _series(series: ResponseSeries) -> Response:
    points = series.points
    gain = _db(np.array([p.gain for p in points]))
    low = _db(np.array([p.gain_low for p in points]))
    high = _db(np.array([np.nan if p.gain_high is None else p.gain_high for p in points]))
    phase = np.degrees(np.unwrap(np.radians([p.phase_deg for p in points])))
    return Response(
        _label(series),
        np.array([p.frequency_hz for p in points]),
        gain,
        phase,
        np.stack([np.maximum(low, gain - WIDE_DB), high], axis=1),
        coherence=np.array([p.coherence for p in points], np.float64),
    )


def _model(curve: ModelCurve, *, first: bool) -> Response:
    f = np.array(curve.frequencies_hz)
    gain, phase = _db(np.array(curve.gain)), np.array(curve.phase_deg)
    return Response("model" if first else "", f, gain, phase, points=False)


def _label(series: ResponseSeries) -> str:
    if series.amplitude_m is not None:
        return f"{quantity(series.amplitude_m, 'm')} under {quantity(series.mean_n, 'N')}"
    mean = f" about {quantity(series.mean_n, 'N')}" if series.mean_n else ""
    return f"{quantity(series.amplitude_n, 'N')}{mean}"


def _marked(found: ResponseOut) -> Iterator[Marked]:
    """Of the first series alone: those of all would lie over one another; they are in the table."""
    if found.unit != "1" or not found.series:
        return
    extremes = found.series[0].extremes
    for one in (extremes.peak, extremes.dip):
        if one is not None:
            text = f"{one.gain_db:+.1f} dB at {one.frequency_hz:.1f} Hz".replace("-", "−")
            yield Marked(one.frequency_hz, one.gain_db, text)


def _extremes(found: ResponseOut) -> Table:
    columns = (
        Column("Amplitude"),
        Column("Peak", number=True),
        Column("Minimum", number=True),
        Column("−3 dB at", number=True),
        Column("−90° at", number=True),
        Column("Points", number=True),
    )
    return Table("Extremes", columns, tuple(_extreme(series) for series in found.series))


def _margins(found: ResponseOut) -> Table:
    heads = ("Crossover", "Phase margin", "Gain margin", "at", "Worst sensitivity", "Points")
    columns = (Column("Amplitude"), *(Column(head, number=True) for head in heads))
    both = zip(found.series, found.margins, strict=True)
    return Table(
        "Margins from the measured loop", columns, tuple(_margin(*series) for series in both)
    )


def _margin(series: ResponseSeries, margins: LoopMargins) -> Row:
    cells = (
        quantity(margins.crossover_hz, "Hz"),
        quantity(margins.phase_margin_deg, "°"),
        quantity(margins.gain_margin_db, "dB"),
        quantity(margins.turnover_hz, "Hz"),
        digits(margins.worst_sensitivity, 3),
        str(len(series.points)),
    )
    return Row((_label(series), *cells))


def _extreme(series: ResponseSeries) -> Row:
    e = series.extremes
    at = [
        NOTHING if one is None else f"{digits(one.gain_db, 3)} dB at {digits(one.frequency_hz)} Hz"
        for one in (e.peak, e.dip)
    ]
    corners = (quantity(e.minus_3_db_hz, "Hz"), quantity(e.minus_90_deg_hz, "Hz"))
    return Row((_label(series), *at, *corners, str(len(series.points))))


def _points(found: ResponseOut) -> Table:
    heads = ("Frequency (Hz)", "Gain (dB)", "95 % (dB)", "Phase (°)", "95 % (°)", "Coherence")
    columns = (Column("Amplitude"), *(Column(head, number=True) for head in heads))
    columns += (Column("Distortion (%)", number=True), Column("Cycles", number=True))
    rows = tuple(_point(series, i) for series in found.series for i in range(len(series.points)))
    caption = "Points of the closed loop, force to setpoint"
    if len(rows) > MOST_ROWS:
        caption += f": the first {MOST_ROWS} of {len(rows):,}"
    return Table(caption, columns, rows[:MOST_ROWS])


def _point(series: ResponseSeries, i: int) -> Row:
    p = series.points[i]
    high = NOTHING if p.gain_high is None else digits(float(_db(np.array(p.gain_high))), 3)
    cells = (
        digits(p.frequency_hz),
        NOTHING if p.gain_db is None else f"{p.gain_db:.2f}".replace("-", "−"),
        f"{digits(float(_db(np.array(p.gain_low))), 3)} … {high}",
        f"{p.phase_deg:.1f}".replace("-", "−"),
        f"{digits(p.phase_low_deg, 3)} … {digits(p.phase_high_deg, 3)}",
        NOTHING if p.coherence is None else f"{p.coherence:.4f}",
        NOTHING if p.distortion_percent is None else digits(p.distortion_percent, 2),
        str(p.cycles),
    )
    return Row((_label(series), *cells))


def _db(gain: np.ndarray) -> np.ndarray:
    return np.asarray(20.0 * np.log10(np.maximum(gain, LEAST_GAIN)))
