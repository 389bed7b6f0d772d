"""Writes down the drills: what was given, in the run that it was given in too, and what came of it."""

import logging
import time
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

from sqlalchemy.exc import SQLAlchemyError

from app.audit.entry import Entry
from app.audit.record import record
from app.db import Database
from app.drills import files, repository
from app.drills.models import FAILED, INTERRUPTED, PASSED, DrillGiven
from app.drills.score import Score
from app.drills.watching import Watched
from app.runs import repository as runs
from app.runs.models import RunTag

_log = logging.getLogger(__name__)
RUN_TAG = "drill"
RETRY_S, ATTEMPTS = 1.0, 30


class Book:
    """The drills of this data directory."""

    def __init__(self, database: Database, folder: Path) -> None:
        self._database = database
        self.folder = folder

    def enter(self, row: DrillGiven) -> int:
        """Enter a drill that is about to be given; its number."""
        with self._database.writing() as session:
            session.add(row)
            session.flush()
            return row.id

    def given(self, number: int, tick: int) -> None:
        """The loop has taken it: the audit and the run that goes on say so."""
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is None:
                return
            row.tick = tick
            told = {"fault": row.fault, "amount": row.amount, "tick": tick, "run": row.run_id}
            record(session, Entry("drills.give", f"drill {number}", after=told))
            run = None if row.run_id is None else runs.to_change(session, row.run_id)
            if run is not None and RUN_TAG not in run.tags:
                run.tag_rows.append(RunTag(tag=RUN_TAG))
                run.annotation += 1

    def withdraw(self, number: int) -> None:
        """The loop has not taken it."""
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is not None:
                session.delete(row)

    def scored(self, number: int, watched: Watched, score: Score) -> None:
        """It is over: keep the samples, then how it went. Tried again while disk or database do not answer."""
        self._insist(lambda: self._keep_samples(number, watched))
        kept = files.path_of(self.folder, number).exists()
        self._insist(
            lambda: self._end(
                number,
                PASSED if score.passed else FAILED,
                first_out=score.first_out,
                reaction_ticks=score.reaction_ticks,
                ticks=len(watched.samples) if kept else 0,
                score=score.model_dump(mode="json"),
            )
        )

    def interrupted(self, number: int, why: str) -> None:
        """It ended without a score."""
        self._insist(lambda: self._end(number, INTERRUPTED, why=why))

    def interrupt_all(self, why: str) -> None:
        """Those that an earlier start has left without an end."""
        with self._database.reading() as session:
            left = [row.id for row in repository.under_way(session)]
        for number in left:
            self._end(number, INTERRUPTED, why=why)

    def _keep_samples(self, number: int, watched: Watched) -> None:
        files.keep(self.folder, number, watched.samples, {"drill": number})

    def _end(self, number: int, state: str, **more: object) -> None:
        with self._database.writing() as session:
            row = repository.to_change(session, number)
            if row is None:
                return
            row.state, row.ended_at = state, datetime.now(UTC)
            for name, value in more.items():
                setattr(row, name, value)
            told = {
                "state": state,
                "first_out": row.first_out,
                "reaction_ticks": row.reaction_ticks,
            }
            record(session, Entry("drills.end", f"drill {number}", row.why, after=told))

    def _insist(self, job: Callable[[], None]) -> None:
        for attempt in range(ATTEMPTS):
            try:
                return job()
            except (OSError, SQLAlchemyError):
                _log.exception("a drill could not be written down (attempt %d)", attempt + 1)
                time.sleep(RETRY_S)
