"""The book of runs that the recorder writes in (`app.recording.clerk.RunBook`)."""

import math
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Any

from app.db import Database
from app.link.events import LoopEvent
from app.recording.clerk import OpenRun
from app.recording.outcome import Ending
from app.recording.run_file import Recorded
from app.runs import repository
from app.runs.models import Run

_FROZEN = (
    *(
        "test_id",
        "test_name",
        "revision",
        "definition",
        "controller",
        "interlocks",
        "rig",
        "conditions",
    ),
    *("software_version", "period_ns"),
)


class Ledger:
    """Writes into the database what the recorder saw; `changed` is called after each run's change."""

    def __init__(self, database: Database, changed: Callable[[], None]) -> None:
        self._database = database
        self._changed = changed

    def open_runs(self) -> Sequence[OpenRun]:
        """The runs without an outcome, oldest first."""
        with self._database.reading() as session:
            runs = repository.without_outcome(session)
            return [OpenRun(run.id, run.first_tick, run.loop_life) for run in runs]

    def began(self, run_id: int, first_tick: int) -> None:
        """Its first tick has been seen."""
        with self._database.writing() as session:
            repository.set_first_tick(session, run_id, first_tick)
        self._changed()

    def reported(self, run_id: int, events: Sequence[LoopEvent]) -> None:
        """The loop reported these; those that are known already stay as they are."""
        with self._database.writing() as session:
            if repository.get(session, run_id) is not None:
                repository.add_events(session, [_row(run_id, event) for event in events])

    def ended(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        """It is over, and its recording is complete."""
        with self._database.writing() as session:
            run = repository.get(session, run_id)
            if run is None:
                return
            _close(run, recorded, ending)
        self._changed()

    def frozen(self, run_id: int) -> dict[str, Any]:
        """The definition, settings and conditions of a run, for its file."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return {"run_id": run_id}
            settings = {name: getattr(run, name) for name in _FROZEN}
            return {"run_id": run_id, "started_at": run.started_at.isoformat(), **settings}


def _close(run: Run, recorded: Recorded, ending: Ending) -> None:
    run.ended_at = datetime.now(UTC)
    run.outcome = ending.outcome.value
    run.reason = ending.reason
    run.ticks = recorded.ticks
    run.duration_s = recorded.ticks * run.period_ns * 1e-9
    run.missing_ticks = recorded.missing_ticks
    if recorded.last_tick >= 0:
        run.first_tick, run.last_tick = recorded.first_tick, recorded.last_tick


def _row(run_id: int, event: LoopEvent) -> dict[str, object]:
    return {
        "run_id": run_id,
        "sequence": event.sequence,
        "tick": event.tick,
        "kind": event.kind,
        "code": event.code,
        "text": event.text,
        "value": event.value if math.isfinite(event.value) else None,
        "limit": event.limit if math.isfinite(event.limit) else None,
    }
