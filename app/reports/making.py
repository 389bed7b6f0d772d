"""Makes a report's file: the work of a process of its own, which opens the database and the samples itself."""

from pathlib import Path

from app.comparison.schemas import RunComparison
from app.db import Database
from app.errors import Refusal
from app.histories.store import Store
from app.jobs.apart import Report as Tell
from app.recording.whole_file import whole_file
from app.reports.branding import Branding, branding
from app.reports.collect import collect
from app.reports.comparison import collect_comparison
from app.reports.of_run import subject_of_run
from app.reports.orders import Format, Order, Sources
from app.reports.rendering import render_html, render_pdf
from app.reports.report import Report

COLLECTED = 0.8  # of the work, nearly


def make(tell: Tell, sources: Sources, order: Order) -> Refusal | None:
    """Make it. Raises `OSError` where it cannot be written."""
    look = branding(sources.logo, sources.template)
    if isinstance(look, Refusal):
        return look
    database = Database(sources.database_url)
    try:
        subject = subject_of_run(
            order.run_id, database, sources.runs_dir, Store(sources.histories_dir)
        )
    finally:
        database.close()
    if isinstance(subject, Refusal):
        return subject
    report = collect(subject, order.extent, lambda share: tell(COLLECTED * share))
    return write(report, look, order.format, order.path)


def write(report: Report, look: Branding, form: Format, path: Path) -> Refusal | None:
    """A report as a file, whole or not at all. Raises `OSError`."""
    made = render_pdf(report, look) if form is Format.PDF else render_html(report, look)
    if isinstance(made, Refusal):
        return made
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as file:
        file.write(made)
    return None


def compare(sources: Sources, comparison: RunComparison) -> bytes | Refusal:
    """The report of runs that have been compared, as PDF."""
    look = branding(sources.logo, sources.template)
    if isinstance(look, Refusal):
        return look
    return render_pdf(collect_comparison(comparison), look)
