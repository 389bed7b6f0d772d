"""The report of several runs beside one another, from what the console's comparison tells of them."""

from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import Any

import numpy as np

from app.comparison.schemas import (
    ComparedChannel,
    ComparedRun,
    MeasurementRow,
    Numbers,
    RunComparison,
    SettingRow,
)
from app.reports.figures.colours import ASKED, GREY, LIMIT, MEASURED, PREDICTED
from app.reports.figures.time import Floats, Panel, Trace, time_figure
from app.reports.numbers import (
    NOTHING,
    digits,
    duration,
    moment,
    quantity,
    scale_of,
    spoken,
    unit_shown,
)
from app.reports.report import (
    Column,
    Figure,
    Item,
    Report,
    Row,
    Section,
    Table,
    Tone,
    Verdict,
    Words,
)
from app.settings import VERSION

COLOURS = (MEASURED, PREDICTED, ASKED, LIMIT, GREY, "#4d7a3a", "#7a3b69", "#2a8f8f")
DASHES = ("-", "--", ":", "-.")


def collect_comparison(found: RunComparison) -> Report:
    """Overlay, differences from the baseline, measurements, and the settings that are not the same."""
    label = f"Runs {', '.join(str(run.id) for run in found.runs)}"
    names = sorted({run.test_name for run in found.runs})
    differ = sum(v.within is False for row in found.measurements for v in row.values)
    sentence = (
        f"{len(found.runs)} runs, run {found.baseline_id} is the baseline. "
        f"Settings that differ: {found.settings_in_all}; measurements beyond their tolerance: {differ}."
    )
    return Report(
        title="Comparison of runs",
        subtitle=names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more",
        label=label,
        verdict=Verdict("COMPARISON", sentence, Tone.QUIET),
        about=(_runs(found.runs),),
        sections=tuple(_sections(found)),
        dated=max(_end(run) for run in found.runs),
        software=f"forcerig {VERSION}",
    )


def _end(run: ComparedRun) -> datetime:
    return run.started_at + timedelta(seconds=run.duration_s or 0.0)


def _runs(runs: Sequence[ComparedRun]) -> Table:
    heads = ("Run", "Test", "Started", "Lasted", "Operator", "Outcome", "Verdict", "Software")
    shares = (0.8, 3.5, 2.6, 1.6, 1.8, 1.6, 1.2, 1.2)
    columns = tuple(Column(head, share=share) for head, share in zip(heads, shares, strict=True))
    rows = tuple(
        Row(
            (
                str(run.id),
                run.test_name
                if run.revision is None
                else f"{run.test_name}, revision {run.revision}",
                moment(run.started_at),
                duration(run.duration_s),
                run.operator or NOTHING,
                NOTHING if run.outcome is None else run.outcome.value,
                run.verdict,
                run.software_version,
            )
        )
        for run in runs
    )
    return Table("Runs, the baseline first", columns, rows)


def _sections(found: RunComparison) -> list[Section]:
    items: list[Item] = [_overlay(found), _differences(found)]
    sections = [Section("Over each other", tuple(items))]
    if found.measurements:
        sections.append(Section("Measurements", (_measurements(found),)))
    sections.append(Section("Settings that differ", _settings(found)))
    return sections


def _overlay(found: RunComparison) -> Figure:
    """Each channel, and below it each run less the baseline."""
    x = np.array(found.overlay.x)
    panels = [panel for channel in found.overlay.channels for panel in _panels(x, channel)]
    caption = "The runs over each other, and each less the baseline"
    if found.overlay.decimated:
        caption += ": least and greatest of each stretch"
    return Figure(caption, time_figure(panels, panel_mm=42.0), caption)


def _panels(x: Floats, channel: ComparedChannel) -> list[Panel]:
    name = f"{spoken(channel.channel)} ({unit_shown(channel.unit)})"
    scale = scale_of(channel.unit)
    over = [
        _trace(x, f"run {one.run_id}", one.min, one.max, scale, i)
        for i, one in enumerate(channel.series)
    ]
    less = [
        _trace(x, f"run {one.run_id} − baseline", one.min, one.max, scale, i)
        for i, one in enumerate(channel.differences, 1)
    ]
    return [Panel(name, over), Panel(f"Difference ({unit_shown(channel.unit)})", less)]


def _trace(x: Floats, label: str, low: Numbers, high: Numbers, scale: float, i: int) -> Trace:
    below = _floats(low) * scale
    above = below if low == high else _floats(high) * scale
    return Trace(label, x, below, above, COLOURS[i % len(COLOURS)], DASHES[i % len(DASHES)])


def _floats(values: Numbers) -> Floats:
    return np.array([np.nan if value is None else value for value in values])


def _differences(found: RunComparison) -> Table:
    columns = (
        Column("Channel"),
        Column("Run"),
        Column("Rms", number=True),
        Column("Largest", number=True),
        Column("At", number=True),
        Column("Compared", number=True),
        Column("In one alone", number=True),
    )
    rows = tuple(
        Row(
            (
                spoken(channel.channel),
                str(one.run_id),
                quantity(one.rms, channel.unit),
                quantity(one.peak, channel.unit),
                _place(one.peak_at, found.overlay.x_unit),
                str(one.compared),
                str(one.one_sided),
            )
        )
        for channel in found.overlay.channels
        for one in channel.differences
    )
    return Table("Differences from the baseline", columns, rows)


def _place(at: float | None, unit: str) -> str:
    return NOTHING if at is None else f"{digits(at, 6)} {unit}"


def _measurements(found: RunComparison) -> Table:
    columns = [Column("Measurement", share=3.0), Column("Block", share=0.8)]
    columns += [Column(f"Run {run.id}", number=True, share=1.6) for run in found.runs]
    rows = tuple(_measured(row) for row in found.measurements)
    return Table("Measurements; what is beyond its tolerance is set apart", tuple(columns), rows)


def _measured(row: MeasurementRow) -> Row:
    beyond = any(value.within is False for value in row.values)
    cells = (quantity(value.value, row.unit) for value in row.values)
    block = "" if row.block is None else str(row.block + 1)
    return Row((spoken(row.name), block, *cells), Tone.BAD if beyond else Tone.PLAIN)


def _settings(found: RunComparison) -> tuple[Item, ...]:
    if not found.settings:
        return (Words("None: the runs were made with the same definition, controller and rig."),)
    columns = [Column("Setting", share=3.0)]
    columns += [Column(f"Run {run.id}", share=1.6) for run in found.runs]
    rows = tuple(_setting(row) for row in found.settings)
    caption = "Settings"
    if found.settings_in_all > len(found.settings):
        caption += f" (the first {len(found.settings)} of {found.settings_in_all:,})"
    return (Table(caption, tuple(columns), rows),)


def _setting(row: SettingRow) -> Row:
    return Row((f"{row.part}: {row.path}", *(_written(value) for value in row.values)))


def _written(value: Any) -> str:
    if value is None:
        return NOTHING
    if isinstance(value, int | float) and not isinstance(value, bool):
        return digits(float(value), 6)
    return str(value)
