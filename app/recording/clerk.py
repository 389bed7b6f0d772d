"""The clerk: writes down what the recorder found, in threads of its own; the drain never waits for it.

What was seen of runs is written down at once, in order; filing and measuring a run that is over may take
minutes, so that has a thread to itself. A job that fails because the database or the disk does not answer
is tried again; what is on disk stays as it is until then.
"""

import logging
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from queue import SimpleQueue
from threading import Event, Thread
from typing import Any, NamedTuple, Protocol

from sqlalchemy.exc import SQLAlchemyError

from app.link.events import LoopEvent
from app.recording.files import convert, keep_parts, remove_parts
from app.recording.outcome import NEVER_BEGAN, Ending
from app.recording.run_file import Recorded

_log = logging.getLogger(__name__)
RETRY_S = 1.0
ATTEMPTS_AT_THE_END = 5


class OpenRun(NamedTuple):
    """A run that nobody has written the end of."""

    id: int
    first_tick: int | None
    loop_life: str


class RunBook(Protocol):
    """Where runs are written down."""

    def open_runs(self) -> Sequence[OpenRun]:
        """The runs without an outcome, oldest first."""

    def began(self, run_id: int, first_tick: int) -> None:
        """Its first tick has been seen."""

    def reported(self, run_id: int, events: Sequence[LoopEvent]) -> None:
        """The loop reported these; those that are known already stay as they are."""

    def ended(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        """It is over, and its recording is complete."""

    def frozen(self, run_id: int) -> dict[str, Any]:
        """The definition, settings and conditions of a run, for its file."""


Job = Callable[[], None]


class Clerk:
    """Does the recorder's paperwork."""

    def __init__(self, runs_dir: Path, book: RunBook) -> None:
        self._runs_dir = runs_dir
        self._book = book
        self._jobs: SimpleQueue[Job | None] = SimpleQueue()
        self._filing: SimpleQueue[Job | None] = SimpleQueue()  # what may take minutes
        self._ending: set[int] = set()  # runs whose end is on its way into the book
        self._stopping = Event()
        self._threads = [
            Thread(target=self._work, args=(queue,), name=name, daemon=True)
            for queue, name in ((self._jobs, "clerk"), (self._filing, "clerk-filing"))
        ]

    def start(self) -> None:
        """Begin to work."""
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """Finish what is on the desk, then end. What fails now is done at the next start."""
        self._stopping.set()
        for queue, thread in zip((self._jobs, self._filing), self._threads, strict=True):
            queue.put(None)  # what is to be filed is known once the first has done
            thread.join()

    def open_runs(self, loop_life: str | None) -> list[OpenRun]:
        """The runs of this life of the loop that have no end yet; None: of every life."""
        runs = [run for run in self._book.open_runs() if run.id not in self._ending]
        return [run for run in runs if loop_life in (None, run.loop_life)]

    def began(self, run_id: int, first_tick: int) -> None:
        """A run's first tick has been seen."""
        self._jobs.put(lambda: self._book.began(run_id, first_tick))

    def reported(self, run_id: int, events: Sequence[LoopEvent]) -> None:
        """The loop reported these of a run."""
        self._jobs.put(lambda: self._book.reported(run_id, events))

    def ended(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        """A run is over: make its file, write its end down, remove what the file was made from."""
        self._ending.add(run_id)
        # In turn behind all that is to be said of the run, but before nobody: another may begin.
        self._jobs.put(lambda: self._filing.put(lambda: self._end(run_id, recorded, ending)))

    def never_began(self, run_id: int) -> None:
        """The loop did not begin a run, and will not any more."""
        self.ended(run_id, Recorded(-1, -1, 0, 0), NEVER_BEGAN)

    def _end(self, run_id: int, recorded: Recorded, ending: Ending) -> None:
        folder = self._runs_dir / str(run_id)
        kept = recorded
        if recorded.ticks:
            kept = convert(folder, self._book.frozen(run_id), recorded, ending)
        self._book.ended(run_id, kept, ending)
        (remove_parts if kept == recorded else keep_parts)(folder)
        self._ending.discard(run_id)
        _log.info("run %d: %s, %d ticks", run_id, ending.outcome, recorded.ticks)

    def work_off(self) -> None:
        """Do what is on the desk now, once, in the thread that calls."""
        for queue in (self._jobs, self._filing):
            while not queue.empty():
                job = queue.get()
                if job is not None:
                    self._done(job)

    def _work(self, queue: SimpleQueue[Job | None]) -> None:
        while (job := queue.get()) is not None:
            attempts = 0
            while not self._done(job) and attempts < ATTEMPTS_AT_THE_END:
                attempts += self._stopping.is_set()
                time.sleep(RETRY_S)

    def _done(self, job: Job) -> bool:
        try:
            job()
        except (SQLAlchemyError, OSError):
            _log.exception("could not write a run down; trying again")
            return False
        except Exception:
            _log.exception("could not write a run down")
        return True
