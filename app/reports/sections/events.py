"""What the loop reported: trips first, then everything in order."""

from app.reports.numbers import digits
from app.reports.report import Column, Item, Row, Section, Table, Tone, Words
from app.reports.subject import Happening, Subject

MOST = 120
_LOUD = frozenset({"trip", "gap", "program_fault", "deadlines_missed", "fault", "refusal"})


def events(subject: Subject) -> Section | None:
    """Trips, and the events in order; of very many the first and the last."""
    reported = [e for e in subject.events if not _is_told(e)]
    trips = [e for e in reported if e.kind == "trip"]
    items: list[Item] = []
    if trips:
        items.append(_table("Trips", trips))
    else:
        items.append(Words("No detector tripped."))
    told = reported
    if len(told) > MOST:
        text = f"{len(told):,} events; those at both ends and all that are no change of block:"
        items.append(Words(text, Tone.QUIET))
        told = _thinned(told)
    if told:
        items.append(_table("Events", told))
    return Section("Events and trips", tuple(items))


def _is_told(event: Happening) -> bool:
    """Whether another event tells it, with what came of it: that the console had the loop skip."""
    return event.kind == "command" and event.code == "skip"


def _thinned(told: list[Happening]) -> list[Happening]:
    ends = {id(e) for e in (*told[: MOST // 4], *told[-MOST // 4 :])}
    kept = [e for e in told if id(e) in ends or e.kind != "block"]
    return kept[: MOST // 2] + kept[max(MOST // 2, len(kept) - MOST // 2) :]


def _table(caption: str, told: list[Happening]) -> Table:
    columns = (
        Column("Time (s)", number=True, share=1.2),
        Column("Kind", share=1.5),
        Column("What happened", share=7.0),
    )
    return Table(caption, columns, tuple(_row(event) for event in told))


def _row(event: Happening) -> Row:
    tone = Tone.BAD if event.kind in _LOUD else Tone.PLAIN
    kind = event.kind.replace("_", " ")
    return Row((digits(event.time_s, 7), kind, event.text), tone)
