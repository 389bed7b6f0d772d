"""What can be asked about runs."""

from pathlib import Path

from app.audit.record import Entry, record
from app.db import Database
from app.errors import Code, Refusal
from app.recording.files import parquet_path
from app.runs import repository
from app.runs.finding import Sought
from app.runs.models import Run, RunTag
from app.runs.no_data import no_data
from app.runs.schemas import (
    RunAnnotation,
    RunDetail,
    RunEventOut,
    RunEvents,
    RunPage,
    RunSummary,
)


class Runs:
    """The runs of this data directory."""

    def __init__(self, database: Database, runs_dir: Path) -> None:
        self._database = database
        self._runs_dir = runs_dir

    def page(self, sought: Sought, limit: int, before: int | None) -> RunPage:
        """The newest runs among those that are sought, or those before a number."""
        with self._database.reading() as session:
            runs = repository.page(session, sought, limit + 1, before)
            shown = [RunSummary.of(run) for run in runs[:limit]]
        return RunPage(runs=shown, next=shown[-1].id if len(runs) > limit else None)

    def detail(self, run_id: int) -> RunDetail | Refusal:
        """A run with everything that it was made with."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            return _unknown(run_id) if run is None else RunDetail.of(run)

    def tags(self) -> list[str]:
        """Every tag that a run has."""
        with self._database.reading() as session:
            return repository.tags(session)

    def operators(self) -> list[str]:
        """Everybody who is noted as an operator."""
        with self._database.reading() as session:
            return repository.operators(session)

    def annotate(self, run_id: int, noted: RunAnnotation) -> RunDetail | Refusal:
        """Note something about a run, on top of what was noted before and nothing else."""
        with self._database.writing() as session:
            run = repository.to_change(session, run_id)
            if run is None:
                return _unknown(run_id)
            if noted.annotation != run.annotation:
                return _conflict(run, noted.annotation)
            before = _noted(run)
            if _note(run, noted):
                run.annotation += 1
                entry = Entry("runs.annotate", f"run {run_id}", before=before, after=_noted(run))
                record(session, entry)
                session.flush()
            return RunDetail.of(run)

    def events(self, run_id: int) -> RunEvents | Refusal:
        """What the loop reported during a run."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            rows = repository.events(session, run_id)
            return RunEvents(events=[RunEventOut.of(row, run) for row in rows])

    def parquet(self, run_id: int) -> Path | Refusal:
        """The file of a run that is over."""
        run = self._row(run_id)
        if isinstance(run, Refusal):
            return run
        if run.outcome is None:
            return Refusal(Code.RUN_UNDER_WAY, f"Run {run_id} is still under way: wait for its end")
        path = parquet_path(self._runs_dir / str(run_id))
        return path if path.exists() else no_data(run)

    def _row(self, run_id: int) -> Run | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            session.expunge(run)
            return run


def _note(run: Run, noted: RunAnnotation) -> bool:
    """Whether that changed anything."""
    before = _noted(run)
    run.notes = run.notes if noted.notes is None else noted.notes
    run.operator = run.operator if noted.operator is None else noted.operator
    if noted.tags is not None and list(noted.tags) != before["tags"]:
        kept = {row.tag: row for row in run.tag_rows}
        run.tag_rows = [kept.get(tag) or RunTag(tag=tag) for tag in noted.tags]
    return before != _noted(run)


def _noted(run: Run) -> dict[str, object]:
    return {"notes": run.notes, "operator": run.operator, "tags": list(run.tags)}


def _conflict(run: Run, annotation: int) -> Refusal:
    now = _noted(run)
    return Refusal(
        Code.EDIT_CONFLICT,
        f"Somebody changed the notes, tags or operator of run {run.id} in the meantime: "
        "look at what they are now, then save on top of that",
        about={"current_annotation": run.annotation, "given_annotation": annotation, "now": now},
    )


def _unknown(run_id: int) -> Refusal:
    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
