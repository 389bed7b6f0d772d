"""The book of runs that the recorder writes in (`app.recording.clerk.RunBook`)."""

import logging
import math
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from app.db import Database
from app.link.events import LoopEvent
from app.prediction.judgement import Judged
from app.recording.clerk import OpenRun
from app.recording.outcome import Ending, Outcome
from app.recording.run_file import Recorded
from app.runs import repository
from app.runs.measuring import Measurer, Subject
from app.runs.models import Run
from app.runs.verdicts import criterion_rows, measurement_rows

_log = logging.getLogger(__name__)
_LONGEST_REASON = 500

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


class _Result(NamedTuple):
    """What measuring came to; `trouble` is a sentence where it failed."""

    judged: Judged | None
    trouble: str | None = None


class Ledger:
    """Writes into the database what the recorder saw.

    `changed` is called after each run's change, `over` with a run's number and ticks once all is written.
    """

    def __init__(
        self,
        database: Database,
        runs_dir: Path,
        measure: Measurer,
        changed: Callable[[], None],
        over: Callable[[int, int], None] = lambda run_id, ticks: None,
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._measure = measure
        self._changed = changed
        self._over = over

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
        """It is over, and its recording is complete: measure it, and write down what came of it."""
        result = self._measured(run_id, recorded, ending)
        with self._database.writing() as session:
            run = repository.to_change(session, run_id)
            if run is None or _is_known_better(run, recorded):
                return
            _close(run, recorded, ending)
            if result.trouble:
                run.reason = " ".join(filter(None, [run.reason, result.trouble]))[:_LONGEST_REASON]
            if result.judged is not None:
                run.verdict = result.judged.verdict.value
                measurements = measurement_rows(run_id, result.judged)
                criteria = criterion_rows(run_id, result.judged)
                repository.set_measured(session, run_id, measurements, criteria)
        self._changed()
        self._over(run_id, recorded.ticks)

    def _measured(self, run_id: int, recorded: Recorded, ending: Ending) -> _Result:
        """Outside of any transaction, for it may take a minute. Nothing in it may lose the run."""
        subject = self._subject(run_id, recorded, ending)
        if subject is None or recorded.ticks == 0:
            return _Result(None)
        try:
            return _Result(self._measure(subject))
        except Exception as error:
            _log.exception("run %d could not be measured", run_id)
            return _Result(None, f"It could not be measured: {error}")

    def _subject(self, run_id: int, recorded: Recorded, ending: Ending) -> Subject | None:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            return (
                None
                if run is None
                else Subject(
                    folder=self._runs_dir / str(run_id),
                    definition=run.definition,
                    controller=run.controller,
                    period_s=run.period_ns * 1e-9,
                    first_tick=recorded.first_tick if recorded.first_tick >= 0 else None,
                    completed=ending.outcome is Outcome.COMPLETED,
                    rig=run.rig,
                )
            )

    def frozen(self, run_id: int) -> dict[str, Any]:
        """The definition, settings and conditions of a run, for its file."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return {"run_id": run_id}
            settings = {name: getattr(run, name) for name in _FROZEN}
            return {"run_id": run_id, "started_at": run.started_at.isoformat(), **settings}


def _is_known_better(run: Run, recorded: Recorded) -> bool:
    """Whether a run with samples is now said to have none: it was given up while it was being filed."""
    return run.outcome is not None and run.ticks > 0 and recorded.ticks == 0


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
