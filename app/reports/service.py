"""The reports of this console: each made once, by a process apart, and kept in the folder of its run."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from app.comparison.schemas import RunComparison
from app.db import Database
from app.documents.canonical import fingerprint
from app.errors import Code, Refusal
from app.jobs.jobs import Job, Jobs, JobState
from app.recording.files import parquet_path
from app.reports.branding import Branding, branding
from app.reports.of_run import under_way
from app.reports.orders import Extent, Format, Order, Sources, carry_out, carry_out_comparison
from app.runs import repository
from app.runs.models import Run
from app.settings import VERSION

LAYOUT = 3  # counts up where the same run would be told otherwise by the same version
LONGEST_S = 120.0
_NOTED = ("outcome", "verdict", "annotation", "reason", "operator", "notes", "software_version")
Made = Refusal | None


@dataclass(frozen=True)
class Ready:
    """A report that is there, and was read: a newer one may take its place on the disk at any time."""

    path: Path
    content: bytes


@dataclass(frozen=True)
class Wanted:
    """What of a run is asked for."""

    run_id: int
    extent: Extent
    format: Format


class Reports:
    """Makes reports, one at a time, and knows those that it is making."""

    def __init__(self, database: Database, sources: Sources) -> None:
        self._database = database
        self._sources = sources
        self._jobs: Jobs[Made] = Jobs("reports")
        self._comparing: Jobs[bytes | Refusal] = Jobs("comparison-reports")
        self._making: dict[Wanted, Job[Made]] = {}
        self._lock = threading.Lock()

    def begin(self, wanted: Wanted) -> Ready | Job[Made] | Refusal:
        """The report, where there is one; else the job that makes it, begun now or before."""
        look = branding(self._sources.logo, self._sources.template)
        if isinstance(look, Refusal):
            return look
        path = self._path(wanted, look)
        if isinstance(path, Refusal):
            return path
        if (ready := _ready(path)) is not None:
            return ready
        with self._lock:
            job = self._making.get(wanted)
            if job is not None and not job.ended.is_set():
                return job
            return self._start(wanted, path)

    def outcome(self, wanted: Wanted, job: Job[Made]) -> Ready | Refusal:
        """What came of a job that has ended."""
        if isinstance(job.result, Refusal):
            return job.result
        if job.state is not JobState.DONE:
            code = Code.BUSY if job.state is JobState.CANCELLED else Code.INVALID_REPORT
            return job.why_not(f"The report of run {wanted.run_id} was not made", code)
        found = self.begin(wanted)
        if isinstance(found, Ready | Refusal):
            return found
        detail = f"Run {wanted.run_id} was changed while its report was made: ask for it again"
        return Refusal(Code.BUSY, detail)

    def compare(self, comparison: RunComparison) -> Job[bytes | Refusal] | Refusal:
        """Set the report of runs that have been compared."""
        return self._comparing.start(
            "Comparison of runs", carry_out_comparison, self._sources, comparison
        )

    def known(self, wanted: Wanted) -> Job[Made] | Refusal:
        """The job that makes a report, or made the last one."""
        with self._lock:
            job = self._making.get(wanted)
        nothing = f"No report of run {wanted.run_id} is being made"
        return job or Refusal(Code.NOT_FOUND, nothing)

    def give_up(self, wanted: Wanted) -> Job[Made] | Refusal:
        """Make a report no further."""
        job = self.known(wanted)
        return job if isinstance(job, Refusal) else self._jobs.cancel(job.id)

    def too_long(self, wanted: Wanted) -> Refusal:
        """Give a report up that nobody waits for any longer."""
        self.give_up(wanted)
        detail = (
            f"The report of run {wanted.run_id} took longer than {LONGEST_S:.0f} s and was given up: "
            "ask again when the machine has less to do, or for the brief one"
        )
        return Refusal(Code.BUSY, detail)

    def close(self) -> None:
        """Give all of them up."""
        self._jobs.close()
        self._comparing.close()

    def _start(self, wanted: Wanted, path: Path) -> Job[Made] | Refusal:
        order = Order(wanted.run_id, wanted.extent, wanted.format, path)
        clean = _leaving_only(path)
        title = f"Report of run {wanted.run_id}"
        job = self._jobs.start(title, carry_out, self._sources, order, then=clean)
        if isinstance(job, Job):
            self._making = {w: j for w, j in self._making.items() if not j.ended.is_set()}
            self._making[wanted] = job
        return job

    def _path(self, wanted: Wanted, look: Branding) -> Path | Refusal:
        """Where the report of the run as it is now is kept: by all that it is made from."""
        with self._database.reading() as session:
            run = repository.get(session, wanted.run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {wanted.run_id}")
            if run.outcome is None:
                return under_way(wanted.run_id)
            content = _content(run)
        folder = self._sources.runs_dir / str(wanted.run_id)
        made_by = {
            "layout": LAYOUT,
            "made_by": VERSION,
        }  # an upgrade may tell the same run otherwise
        key = fingerprint({**content, **made_by, **_of(look), "data": _data(folder)})
        return folder / f"report-{wanted.extent}-{key[:16]}.{wanted.format}"


def _ready(path: Path) -> Ready | None:
    try:
        return Ready(path, path.read_bytes())
    except FileNotFoundError:
        return None


def _content(run: Run) -> dict[str, object]:
    removed = run.samples_removed_at
    told = {name: getattr(run, name) for name in _NOTED} | {"tags": list(run.tags)}
    return told | {"removed": None if removed is None else removed.isoformat()}


def _of(look: Branding) -> dict[str, object]:
    logo = None if look.logo is None else [look.logo[0], look.logo[1].hex()]
    return {"typst": look.typst, "html": look.html, "logo": logo}


def _data(folder: Path) -> list[int] | None:
    try:
        found = parquet_path(folder).stat()
    except OSError:
        return None
    return [found.st_size, found.st_mtime_ns]


def _leaving_only(path: Path) -> Callable[[Made], Made]:
    """Removes the reports of the same kind that the new one takes the place of."""

    def clean(made: Made) -> Made:
        kind = path.name.rsplit("-", 1)[0]
        for old in path.parent.glob(f"{kind}-*{path.suffix}"):
            if old != path:
                old.unlink(missing_ok=True)
        return made

    return clean
