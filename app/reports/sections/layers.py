"""Layers and cycles: what each sine of the test came to, how its cycles spread, its harmonics; steps; rainflow."""

import numpy as np

from app.reports.figures.plain import Line, against
from app.reports.numbers import NOTHING, digits, duration, quantity
from app.reports.report import Column, Figure, Item, Row, Section, Table
from app.reports.subject import Subject
from app.run_analysis.schemas import LayerOut, RainflowOut, RunAnalysis, SpreadOut, StepOut

MOST_ROWS = 100
HARMONICS = 5


def layers(subject: Subject) -> Section | None:
    """Nothing where the test has neither layers nor steps."""
    if subject.found is None:
        return None
    found = subject.found.analysis
    items: list[Item] = []
    if found.layers:
        items.append(_layers(found))
        fitted = [layer for layer in found.layers if layer.amplitude_n is not None]
        if len(fitted) > 2:
            items.append(_figure(fitted))
        if fitted:
            items.append(_harmonics(fitted))
    if found.steps:
        items.append(_steps(found))
    if found.unit:
        items.append(_unit(found))
    if found.rainflow.applied_cycles > 1:
        items += [_rainflow(found.rainflow), _damage(found)]
    return Section("Layers, cycles and steps", tuple(items)) if items else None


def _layers(found: RunAnalysis) -> Table:
    heads = ("Asked for", "Cycles", "Amplitude", "Mean", "Phase", "Peaks ± σ", "Valleys ± σ")
    columns = (Column("Block"), *(Column(head, number=True) for head in heads))
    caption = "Layers: what was asked for, and what was applied"
    if found.layers_in_all > MOST_ROWS:
        caption += f" (the first {MOST_ROWS} of {found.layers_in_all:,})"
    return Table(caption, columns, tuple(_layer(layer) for layer in found.layers[:MOST_ROWS]))


def _layer(layer: LayerOut) -> Row:
    cells = (
        _asked(layer),
        f"{layer.cycles:,}",
        quantity(layer.amplitude_n, "N"),
        quantity(layer.mean_n, "N"),
        NOTHING if layer.phase_deg is None else f"{layer.phase_deg:.1f}°".replace("-", "−"),
        _spread(layer.peak_n),
        _spread(layer.valley_n),
    )
    return Row((str(layer.block + 1), *cells))


def _asked(layer: LayerOut) -> str:
    sine = layer.asked
    if sine is None:
        return "sweep"
    mean = f" about {quantity(sine.mean_n, 'N')}" if sine.mean_n else ""
    return f"{quantity(sine.amplitude_n, 'N')}{mean}, {digits(sine.frequency_hz)} Hz"


def _spread(found: SpreadOut) -> str:
    if found.count == 0 or found.mean is None:
        return NOTHING
    about = "" if found.deviation is None else f" ± {digits(found.deviation * 1e-3, 2)}"
    return f"{digits(found.mean * 1e-3)}{about} kN"


def _figure(fitted: list[LayerOut]) -> Figure:
    number = np.arange(1.0, len(fitted) + 1)
    error = _values([layer.amplitude_error_percent for layer in fitted])
    phase = _values([layer.phase_deg for layer in fitted])
    pairs = (
        ("Layer", "Amplitude error (%)", [Line("", number, error, joined=False)]),
        ("Layer", "Phase (°)", [Line("", number, phase, joined=False)]),
    )
    caption = "Amplitude error and phase of each layer"
    return Figure(caption, against(pairs, height_mm=55.0), caption)


def _values(found: list[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in found])


def _harmonics(fitted: list[LayerOut]) -> Table:
    orders = [f"{n}×" for n in range(2, HARMONICS + 2)]
    columns = (
        Column("Block"),
        Column("Asked for", number=True),
        Column("Distortion (%)", number=True),
        *(Column(f"{order} (%)", number=True) for order in orders),
    )
    caption = "Harmonics of the force, in % of the first"
    return Table(caption, columns, tuple(_row(layer) for layer in fitted[:MOST_ROWS]))


def _row(layer: LayerOut) -> Row:
    shares = {h.order: h.percent for h in layer.harmonics}
    cells = [digits(shares.get(n), 2) for n in range(2, HARMONICS + 2)]
    distortion = digits(layer.distortion_percent, 2)
    return Row((str(layer.block + 1), _asked(layer), distortion, *cells))


def _steps(found: RunAnalysis) -> Table:
    heads = ("At", "From", "To", "Dead time", "Rise", "Overshoot", "Settling", "Steady error")
    columns = (Column("Block"), *(Column(head, number=True) for head in heads))
    caption = "Steps"
    if found.steps_in_all > MOST_ROWS:
        caption += f" (the first {MOST_ROWS} of {found.steps_in_all:,})"
    return Table(caption, columns, tuple(_step(step) for step in found.steps[:MOST_ROWS]))


def _step(step: StepOut) -> Row:
    times = (duration(value) for value in (step.dead_time_s, step.rise_s))
    cells = (
        str(step.block + 1),
        duration(step.time_s),
        quantity(step.begin_n, "N"),
        quantity(step.end_n, "N"),
        *times,
        quantity(step.overshoot_percent, "%"),
        duration(step.settling_s),
        quantity(step.steady_error_n, "N"),
    )
    return Row(cells)


def _unit(found: RunAnalysis) -> Table:
    """Stiffness in kN/mm, which is what people say it in."""
    heads = ("Asked for", "Cycles", "Static stiffness ± σ", "Hysteresis ± σ", "Backlash")
    columns = (Column("Block"), *(Column(head, number=True) for head in heads))
    rows = tuple(
        Row(
            (
                str(one.block + 1),
                f"{quantity(one.asked.amplitude_n, 'N')} at {digits(one.asked.frequency_hz)} Hz",
                f"{one.cycles:,}",
                f"{_of(one.stiffness_n_m, 1e-6)} ± {_of(one.stiffness_std_n_m, 1e-6)} kN/mm",
                f"{_of(one.hysteresis_j, 1.0)} ± {_of(one.hysteresis_std_j, 1.0)} J",
                f"{_of(one.backlash_m, 1e6)} µm",
            )
        )
        for one in found.unit
    )
    return Table("The unit under test, from slow cycles that push and pull", columns, rows)


def _of(value: float | None, scale: float) -> str:
    return digits(None if value is None else scale * value, 3)


def _rainflow(found: RainflowOut) -> Table:
    columns = (
        Column("Range", number=True),
        Column("Cycles asked for", number=True),
        Column("Cycles applied", number=True),
    )
    caption = (
        f"Rainflow counting of every tick, ranges above {quantity(found.gate_n, 'N')}: "
        f"{digits(found.asked_cycles)} cycles asked for, {digits(found.applied_cycles)} applied"
    )
    told = [one for one in found.spectrum if one.asked or one.applied]
    rows = tuple(
        Row(
            (
                f"{quantity(one.from_n, 'N')} … {quantity(one.to_n, 'N')}",
                digits(one.asked),
                digits(one.applied),
            )
        )
        for one in told[:MOST_ROWS]
    )
    return Table(caption, columns, rows)


def _damage(found: RunAnalysis) -> Table:
    columns = (
        Column("Wöhler exponent", number=True),
        Column("Equal amplitude, asked for", number=True),
        Column("Equal amplitude, applied", number=True),
        Column("Damage applied / asked for", number=True),
    )
    rows = tuple(
        Row(
            (
                digits(one.exponent),
                quantity(one.asked_amplitude_n, "N"),
                quantity(one.applied_amplitude_n, "N"),
                digits(one.ratio),
            )
        )
        for one in found.damage
    )
    return Table("Damage against the spectrum that was asked for", columns, rows)
