"""What the loop reported, as a report tells it."""

from types import SimpleNamespace
from typing import Any, cast

from app.reports.report import Section, Table
from app.reports.sections.events import events
from app.reports.subject import Happening, Subject


def told(*happenings: Happening) -> list[str]:
    """The last column of the last table."""
    section = events(cast(Subject, SimpleNamespace(events=happenings)))
    assert isinstance(section, Section)
    table: Any = section.items[-1]
    assert isinstance(table, Table)
    return [row.cells[-1] for row in table.rows]


def test_that_the_loop_was_asked_to_skip_is_told_by_what_it_skipped() -> None:
    start = Happening(0.0, "command", "start", "Start")
    asked = Happening(1.0, "command", "skip", "Skip")
    done = Happening(1.0, "skipped", "4", "Went on with the frequency response 2.8 s early")
    assert told(start, asked, done) == [start.text, done.text]
