"""Each block by itself: what it did at its end, and everything that was measured of it."""

from collections.abc import Iterator

from app.documents.units import unit_of
from app.reports.numbers import duration, quantity, spoken
from app.reports.report import Item, Section, Words
from app.reports.sections.results import table_of
from app.reports.sections.time import near
from app.reports.subject import Subject
from app.runs.results_schemas import BlockMeasurements

MOST = 60
CYCLES_SHOWN = 6
SHOWN_S = 0.25


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
    within = _times(subject, block.block)
    if within is not None and subject.samples is not None:
        from_s, to_s = within
        shown_s = min(_shown_s(asked), to_s - from_s)
        start = max(from_s, 0.5 * (from_s + to_s - shown_s))
        caption = f"Block {block.block + 1}: {duration(shown_s)} in its middle, every tick"
        items.append(near(subject, start, start + shown_s, caption))
    table = table_of(block.measurements, f"Block {block.block + 1}")
    if table is not None:
        items.append(table)
    return Section(
        f"Block {block.block + 1}: {spoken(block.kind).lower()}", tuple(items), own_page=True
    )


def _shown_s(asked: dict[str, object]) -> float:
    frequency = asked.get("frequency_hz")
    whole = isinstance(frequency, int | float) and frequency > 0
    return CYCLES_SHOWN / float(frequency) if whole else SHOWN_S  # type: ignore[arg-type]


def _times(subject: Subject, block: int) -> tuple[float, float] | None:
    """From when to when a block went on, by what the loop reported."""
    starts = [e for e in subject.events if e.kind == "block"]
    for i, event in enumerate(starts):
        if event.code == str(block):
            last = subject.ticks * subject.period_s
            return event.time_s, starts[i + 1].time_s if i + 1 < len(starts) else last
    return None


def _asked(asked: dict[str, object]) -> str:
    """What the test asks of it, in one line."""
    told = []
    for name, value in asked.items():
        if isinstance(value, int | float) and not isinstance(value, bool):
            told.append(f"{spoken(name).lower()} {quantity(float(value), _unit(name))}")
    return "Asked for: " + ("; ".join(told) if told else "see the definition") + "."


def _unit(name: str) -> str:
    return unit_of(name) or ""
