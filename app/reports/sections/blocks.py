"""Each block by itself: what it did at its end, and everything that was measured of it."""

from collections.abc import Iterator

from app.documents.units import unit_of
from app.reports.numbers import quantity, spoken
from app.reports.report import Item, Section, Words
from app.reports.sections.results import table_of
from app.reports.sections.time import close_up
from app.reports.subject import Subject
from app.reports.telling import moment_of_block, spans_of
from app.runs.results_schemas import BlockMeasurements

MOST = 60


def blocks(subject: Subject) -> Iterator[Section]:
    """A section a block that was reached; of a test with one block the run says it all."""
    reached = subject.measured.blocks
    if len(reached) < 2:
        return
    for block in reached[:MOST]:
        yield _block(subject, block)
    if len(reached) > MOST:
        left = len(reached) - MOST
        text = f"{left:,} more blocks are in the table of the results only."
        yield Section("More blocks", (Words(text),))


def _block(subject: Subject, block: BlockMeasurements) -> Section:
    asked = subject.frozen.definition["blocks"][block.block]
    items: list[Item] = [Words(_asked(asked))]
    if subject.samples is not None and block.block in spans_of(subject):
        items.append(close_up(subject, moment_of_block(subject, block.block)))
    table = table_of(block.measurements, f"Block {block.block + 1}")
    if table is not None:
        items.append(table)
    return Section(
        f"Block {block.block + 1}: {spoken(block.kind).lower()}", tuple(items), own_page=True
    )


def _asked(asked: dict[str, object]) -> str:
    """What the test asks of it, in one line."""
    told = []
    for name, value in asked.items():
        if isinstance(value, int | float) and not isinstance(value, bool):
            told.append(f"{spoken(name).lower()} {quantity(float(value), _unit(name))}")
    return "Asked for: " + ("; ".join(told) if told else "see the definition") + "."


def _unit(name: str) -> str:
    return unit_of(name) or ""
