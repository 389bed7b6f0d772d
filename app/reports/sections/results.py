"""What was measured: of the run as a whole, and of its blocks at a glance."""

from collections.abc import Sequence

from app.analysis.measurements import MEASUREMENTS
from app.reports.numbers import NOTHING, digits, duration, quantity, scale_of, spoken, unit_shown
from app.reports.report import Column, Item, Row, Section, Table, Words
from app.reports.subject import Subject
from app.runs.results_schemas import BlockMeasurements, MeasuredValue

_AT_A_GLANCE = (
    *("cycles", "amplitude_error_percent", "phase_deg", "force_error_rms_n"),
    *("force_error_peak_n", "peak_force_n", "step_overshoot_percent"),
)


def results(subject: Subject) -> Section | None:
    """Measurements; nothing where nothing was measured."""
    items: list[Item] = []
    whole = table_of(subject.measured.run, "The whole run")
    if whole is not None:
        items.append(whole)
    if subject.measured.blocks:
        items.append(_blocks(subject.measured.blocks))
    if subject.missing_ticks:
        missing = duration(subject.missing_ticks * subject.period_s)
        items.append(Words(f"{subject.missing_ticks:,} ticks ({missing}) were not recorded."))
    return Section("Results", tuple(items)) if items else None


def table_of(values: Sequence[MeasuredValue], caption: str) -> Table | None:
    """The measurements that have a value, with what each is; None where none has."""
    rows = [
        Row((spoken(v.name), quantity(v.value, v.unit), MEASUREMENTS[v.name].doc))
        if v.name in MEASUREMENTS
        else Row((spoken(v.name), quantity(v.value, v.unit), ""))
        for v in values
        if v.value is not None
    ]
    columns = (
        Column("Measurement", share=3.0),
        Column("Value", number=True, share=2.0),
        Column("What it is", share=6.0),
    )
    return Table(caption, columns, tuple(rows)) if rows else None


def _blocks(blocks: Sequence[BlockMeasurements]) -> Table:
    """A row a block, a column a measurement that any of them has."""
    had = {m.name for block in blocks for m in block.measurements if m.value is not None}
    names = [name for name in _AT_A_GLANCE if name in had]
    columns = [Column("Block", share=0.7), Column("Kind", share=1.6)]
    for name in names:
        unit = unit_shown(MEASUREMENTS[name].unit)
        head = f"{spoken(name)} ({unit})" if unit else spoken(name)
        columns.append(Column(head, number=True, share=1.4))
    rows = tuple(Row((str(b.block + 1), spoken(b.kind), *_cells(b, names))) for b in blocks)
    return Table("Blocks", tuple(columns), rows)


def _cells(block: BlockMeasurements, names: Sequence[str]) -> list[str]:
    found = {m.name: m for m in block.measurements}
    cells = []
    for name in names:
        m = found.get(name)
        value = None if m is None else m.value
        scale = scale_of(MEASUREMENTS[name].unit)
        cells.append(NOTHING if value is None else digits(value * scale))
    return cells
