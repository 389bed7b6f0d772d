"""What is asked of the process that makes a report. Light: the console itself never loads what draws."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from app.comparison.schemas import RunComparison
from app.errors import Refusal
from app.jobs.apart import Report as Tell


class Extent(StrEnum):
    """How much is told: what fits on two pages or so, or all of it."""

    BRIEF = "brief"
    FULL = "full"


class Format(StrEnum):
    """What a report is written as."""

    PDF = "pdf"
    HTML = "html"


@dataclass(frozen=True)
class Sources:
    """Where a console keeps what reports are made from, and what they are made to look like."""

    database_url: str
    runs_dir: Path
    histories_dir: Path
    logo: Path | None = None
    template: Path | None = None


@dataclass(frozen=True)
class Order:
    """A report to make, and the file that it goes to."""

    run_id: int
    extent: Extent
    format: Format
    path: Path


def carry_out(tell: Tell, sources: Sources, order: Order) -> Refusal | None:
    """Make the report, in a process apart: what it takes to draw is only loaded there."""
    from app.reports.making import make

    return make(tell, sources, order)


def carry_out_comparison(
    tell: Tell, sources: Sources, comparison: RunComparison
) -> bytes | Refusal:
    """Set the report of runs that have been compared, likewise; it is not kept."""
    from app.reports.making import compare

    return compare(sources, comparison)
