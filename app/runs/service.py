"""What can be asked about runs."""

from pathlib import Path

from app.db import Database
from app.errors import Code, Refusal
from app.recording.files import parquet_path
from app.runs import repository
from app.runs.models import Run
from app.runs.schemas import (
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

    def page(self, limit: int, before: int | None) -> RunPage:
        """The newest runs, or those before a number."""
        with self._database.reading() as session:
            runs = repository.page(session, limit + 1, before)
            shown = [RunSummary.of(run) for run in runs[:limit]]
        return RunPage(runs=shown, next=shown[-1].id if len(runs) > limit else None)

    def detail(self, run_id: int) -> RunDetail | Refusal:
        """A run with everything that it was made with."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            return _unknown(run_id) if run is None else RunDetail.of(run)

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
        return path if path.exists() else _no_data(run_id)

    def _row(self, run_id: int) -> Run | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            session.expunge(run)
            return run


def _unknown(run_id: int) -> Refusal:
    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")


def _no_data(run_id: int) -> Refusal:
    return Refusal(Code.NO_DATA, f"Run {run_id} has no samples")
