"""What is noted without a transaction: kept in a file at once, entered when the database can."""

import logging
from collections import deque
from threading import Condition, Event, Thread
from uuid import uuid4

from sqlalchemy.exc import SQLAlchemyError

from app.audit.entry import Act, Entry, act
from app.audit.record import enter
from app.audit.spool import Spool
from app.db import Database

_log = logging.getLogger(__name__)
MOST_WAITING = 10_000  # in memory, while even the file cannot be written
AT_A_TIME = 200
AGAIN_S = 1.0
PATIENCE_S = 3.0  # at the end; what is not entered by then stays in the file


class Notes:
    """Two threads: one writes the file, the other empties it into the database.

    Whoever notes something waits for neither.
    """

    def __init__(self, database: Database, spool: Spool) -> None:
        self._database = database
        self._spool = spool
        self._waiting: deque[Act] = deque()
        self._lost = 0
        self._changed = Condition()
        self._spooled = Event()
        self._ended = Event()
        self._troubles: set[str] = set()
        self._threads = (
            Thread(target=self._keep, name="audit spool", daemon=True),
            Thread(target=self._enter, name="audit", daemon=True),
        )

    def start(self) -> None:
        """Begin, with what a console before this one could not enter."""
        self._spooled.set()
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Keep what is waiting, enter it if the database can, and end the threads."""
        with self._changed:
            self._ended.set()
            self._changed.notify()
        for thread in self._threads:
            self._spooled.set()
            thread.join(PATIENCE_S)

    def take(self, noted: Act) -> None:
        """Take an act. Returns at once."""
        with self._changed:
            if len(self._waiting) >= MOST_WAITING:
                self._lost += 1
            else:
                self._waiting.append(noted)
            self._changed.notify()

    # ---- into the file ----

    def _keep(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._waiting or self._lost or self._ended.is_set())
                acts = list(self._waiting)
                lost = self._lost
            if not acts and not lost:
                return
            if self._kept(acts, lost):
                self._spooled.set()
            elif self._ended.wait(AGAIN_S):
                return

    def _kept(self, acts: list[Act], lost: int) -> bool:
        told = Entry("audit.lost", "notes", why="there was no room for them", after={"acts": lost})
        try:
            self._spool.append([*acts, *([act(told, uuid4().hex)] if lost else [])])
        except OSError as error:
            self._trouble("written", error)
            return False
        self._troubles.discard("written")
        with self._changed:
            for _ in acts:
                self._waiting.popleft()
            self._lost -= lost
        return True

    # ---- into the database ----

    def _enter(self) -> None:
        while True:
            self._spooled.wait()
            self._spooled.clear()
            last = (
                self._ended.is_set() and not self._threads[0].is_alive()
            )  # nothing comes any more
            while not self._emptied():
                if self._ended.wait(AGAIN_S):
                    return
            if last:
                return

    def _emptied(self) -> bool:
        """Whether all that is in the file is in the database now."""
        try:
            while (batch := self._spool.oldest(AT_A_TIME)).acts:
                with self._database.writing() as session:
                    enter(session, batch.acts)
                self._spool.drop(batch.end)
            self._spool.drop(batch.end)
        except (SQLAlchemyError, OSError) as error:
            self._trouble("entered", error)
            return False
        self._troubles.discard("entered")
        return True

    def _trouble(self, what: str, error: Exception) -> None:
        """Say it once, not once a second."""
        if what not in self._troubles:
            _log.warning("audit: what was noted cannot be %s yet: %s", what, error)
            self._troubles.add(what)
