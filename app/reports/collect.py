"""The report of a run: a table of sections, each present where it has something to say."""

from collections.abc import Callable, Iterable
from typing import NamedTuple

from app.reports.orders import Extent
from app.reports.report import Report, Section
from app.reports.sections.against import across
from app.reports.sections.blocks import blocks
from app.reports.sections.data import data
from app.reports.sections.events import events
from app.reports.sections.front import about, verdict_of
from app.reports.sections.layers import layers
from app.reports.sections.margins import margins
from app.reports.sections.realtime import realtime
from app.reports.sections.response import response
from app.reports.sections.results import results
from app.reports.sections.settings import settings
from app.reports.sections.time import overview, time
from app.reports.sections.uncertainty import uncertainty
from app.reports.subject import Subject

Progress = Callable[[float], None]


class _Entry(NamedTuple):
    make: Callable[[Subject], Section | Iterable[Section] | None]
    brief: bool  # whether it is in the short report
    full: bool = True


SECTIONS: tuple[_Entry, ...] = (
    _Entry(overview, brief=True, full=False),
    _Entry(results, brief=False),
    _Entry(time, brief=False),
    _Entry(response, brief=False),
    _Entry(layers, brief=False),
    _Entry(across, brief=False),
    _Entry(uncertainty, brief=False),
    _Entry(margins, brief=False),
    _Entry(events, brief=False),
    _Entry(realtime, brief=False),
    _Entry(data, brief=True),
    _Entry(blocks, brief=False),
    _Entry(settings, brief=False),
)


def collect(
    subject: Subject, extent: Extent = Extent.FULL, progress: Progress = lambda share: None
) -> Report:
    """All that there is to say of a run."""
    wanted = [e for e in SECTIONS if (e.full if extent is Extent.FULL else e.brief)]
    sections: list[Section] = []
    for i, entry in enumerate(wanted):
        found = entry.make(subject)
        if isinstance(found, Section):
            sections.append(found)
        elif found is not None:
            sections.extend(found)
        progress((i + 1) / len(wanted))
    return Report(
        title="Test report",
        subtitle=subject.test_name,
        label=subject.label,
        verdict=verdict_of(subject),
        about=about(subject),
        sections=tuple(sections),
        dated=subject.ended_at,
        software=f"forcerig {subject.software}",
    )
