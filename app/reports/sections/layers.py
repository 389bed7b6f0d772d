"""Layers and cycles: what each sine of the test came to, how its cycles spread, and its harmonics."""

import numpy as np

from app.analysis.time_domain import Layer, Step
from app.reports.figures.plain import Line, against
from app.reports.numbers import NOTHING, digits, duration, quantity
from app.reports.report import Column, Figure, Item, Row, Section, Table
from app.reports.subject import Subject

MOST_ROWS = 100
HARMONICS = 5


def layers(subject: Subject) -> Section | None:
    """Layers, and steps; nothing where the test has neither."""
    if subject.found is None:
        return None
    found = subject.found.in_time
    items: list[Item] = []
    if found.layers:
        items.append(_layers(found.layers))
        fitted = [layer for layer in found.layers if layer.found is not None]
        if len(fitted) > 2:
            items.append(_figure(fitted))
        if fitted:
            items.append(_harmonics(fitted))
    if found.steps:
        items.append(_steps(found.steps, subject.period_s))
    return Section("Layers, cycles and steps", tuple(items)) if items else None


def _layers(found: tuple[Layer, ...]) -> Table:
    heads = ("Asked for", "Cycles", "Amplitude", "Mean", "Phase", "Peaks ± σ", "Valleys ± σ")
    columns = (Column("Block"), *(Column(head, number=True) for head in heads))
    caption = "Layers: what was asked for, and what was applied"
    if len(found) > MOST_ROWS:
        caption += f" (the first {MOST_ROWS} of {len(found):,})"
    return Table(caption, columns, tuple(_layer(layer) for layer in found[:MOST_ROWS]))


def _layer(layer: Layer) -> Row:
    fit, cycles = layer.found, layer.cycles
    cells = (
        _asked(layer),
        f"{cycles.count:,}",
        NOTHING if fit is None else quantity(fit.amplitude_n, "N"),
        NOTHING if fit is None else quantity(fit.mean_n, "N"),
        NOTHING if fit is None else f"{fit.phase_deg:.1f}°".replace("-", "−"),
        _spread(cycles.peak_n.mean, cycles.peak_n.deviation, cycles.peak_n.count),
        _spread(cycles.valley_n.mean, cycles.valley_n.deviation, cycles.valley_n.count),
    )
    return Row((str(layer.block + 1), *cells))


def _asked(layer: Layer) -> str:
    sine = layer.sine
    if sine is None:
        return "sweep"
    mean = f" about {quantity(sine.mean_n, 'N')}" if sine.mean_n else ""
    return f"{quantity(sine.amplitude_n, 'N')}{mean}, {digits(sine.frequency_hz)} Hz"


def _spread(mean_n: float, deviation_n: float | None, count: int) -> str:
    if count == 0:
        return NOTHING
    about = "" if deviation_n is None else f" ± {digits(deviation_n * 1e-3, 2)}"
    return f"{digits(mean_n * 1e-3)}{about} kN"


def _figure(fitted: list[Layer]) -> Figure:
    number = np.arange(1.0, len(fitted) + 1)
    error = np.array([layer.found.amplitude_error_percent for layer in fitted if layer.found])
    phase = np.array([layer.found.phase_deg for layer in fitted if layer.found])
    pairs = (
        ("Layer", "Amplitude error (%)", [Line("", number, error, joined=False)]),
        ("Layer", "Phase (°)", [Line("", number, phase, joined=False)]),
    )
    caption = "Amplitude error and phase of each layer"
    return Figure(caption, against(pairs, height_mm=55.0), caption)


def _harmonics(fitted: list[Layer]) -> Table:
    orders = [f"{n}×" for n in range(2, HARMONICS + 2)]
    columns = (
        Column("Block"),
        Column("Asked for", number=True),
        Column("Distortion (%)", number=True),
        *(Column(f"{order} (%)", number=True) for order in orders),
    )
    caption = "Harmonics of the force, in % of the first"
    return Table(caption, columns, tuple(_row(layer) for layer in fitted[:MOST_ROWS]))


def _row(layer: Layer) -> Row:
    shares = {h.order: h.percent for h in layer.harmonics}
    cells = [digits(shares[n], 2) if n in shares else NOTHING for n in range(2, HARMONICS + 2)]
    distortion = None if layer.found is None else layer.found.distortion_percent
    return Row((str(layer.block + 1), _asked(layer), digits(distortion, 2), *cells))


def _steps(found: tuple[Step, ...], period_s: float) -> Table:
    heads = ("At", "From", "To", "Dead time", "Rise", "Overshoot", "Settling", "Steady error")
    columns = (Column("Block"), *(Column(head, number=True) for head in heads))
    rows = tuple(
        Row(
            (
                str(step.block + 1),
                duration(step.program_tick * period_s),
                quantity(step.begin_n, "N"),
                quantity(step.end_n, "N"),
                _seconds(step.response.dead_time_s),
                _seconds(step.response.rise_s),
                f"{digits(step.response.overshoot_percent, 3)} %",
                _seconds(step.response.settling_s),
                _force(step.response.steady_error),
            )
        )
        for step in found[:MOST_ROWS]
    )
    return Table("Steps", columns, rows)


def _force(value: float) -> str:
    return quantity(value, "N") if np.isfinite(value) else NOTHING


def _seconds(value: float) -> str:
    return duration(value) if np.isfinite(value) else NOTHING
