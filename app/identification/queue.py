"""The identifications under way: one at a time, in a process of its own, and what is known of how far each is."""

import contextvars
import logging
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial

from sqlalchemy.exc import OperationalError

from app.errors import Refusal
from app.identification.book import Book
from app.identification.models import State
from app.identification.schemas import Identified
from app.jobs.apart import GivenUp, Report, WorkFailed

AGAIN_S = 1.0  # after a write that could not be made
LEAST_SHARE = 0.02  # before that nothing can be said of the time that is left
GIVEN_UP = "It was given up"
ENDED = "The console was ended in the middle of it: start it again"
_log = logging.getLogger(__name__)

Work = Callable[[Report, threading.Event], Identified | Refusal]


@dataclass
class Turn:
    """How far an identification is; `unwanted` once nobody waits for it any more."""

    share: float = 0.0
    began_s: float | None = None
    unwanted: threading.Event = field(default_factory=threading.Event)

    @property
    def seconds_left(self) -> float | None:
        """None where nothing can be said yet."""
        if self.began_s is None or self.share < LEAST_SHARE:
            return None
        return (time.monotonic() - self.began_s) * (1.0 / self.share - 1.0)

    def report(self, share: float) -> None:
        """The share that is done, 0…1."""
        self.share = share


class Queue:
    """Works on what was entered in the book, in that order."""

    def __init__(self, book: Book) -> None:
        self._book = book
        self._worker = ThreadPoolExecutor(1, "identification")
        self._turns: dict[int, Turn] = {}
        self._ending = threading.Event()

    def __len__(self) -> int:
        return len(self._turns)

    def put(self, number: int, work: Work) -> None:
        """Have it done once it is its turn, in the name of whoever asks now."""
        self._turns[number] = turn = Turn()
        context = contextvars.copy_context()
        self._worker.submit(context.run, self._carry_out, number, turn, work)

    def turn(self, number: int) -> Turn | None:
        """How far it is; None of one that is not under way."""
        return self._turns.get(number)

    def give_up(self, number: int) -> None:
        """Nobody wants it any more. One that is under way in the book and has no turn ends there and then."""
        if (turn := self._turns.get(number)) is not None:
            turn.unwanted.set()
        else:
            self._book.ended(number, State.INTERRUPTED, ENDED)

    def close(self) -> None:
        """Give all of them up."""
        self._ending.set()
        for turn in list(self._turns.values()):
            turn.unwanted.set()
        self._worker.shutdown()

    def _carry_out(self, number: int, turn: Turn, work: Work) -> None:
        try:
            self._write(number, self._come_of(number, turn, work))
        finally:
            del self._turns[number]

    def _come_of(self, number: int, turn: Turn, work: Work) -> Callable[[], None]:
        """Work on it; what is to be written down of its end."""
        try:
            return self._work(number, turn, work)
        except GivenUp:
            ending = self._ending.is_set()
            state = State.INTERRUPTED if ending else State.CANCELLED
            return partial(self._book.ended, number, state, ENDED if ending else GIVEN_UP)
        except WorkFailed as error:
            return partial(self._book.ended, number, State.FAILED, str(error))
        except Exception as error:
            _log.exception("identification %d", number)
            return partial(self._book.ended, number, State.FAILED, str(error))

    def _work(self, number: int, turn: Turn, work: Work) -> Callable[[], None]:
        if turn.unwanted.is_set():
            raise GivenUp
        turn.began_s = time.monotonic()
        self._write(number, partial(self._book.begun, number))
        found = work(turn.report, turn.unwanted)
        if isinstance(found, Refusal):
            return partial(self._book.ended, number, State.FAILED, found.detail)
        return partial(self._book.done, number, found)

    def _write(self, number: int, write: Callable[[], None]) -> None:
        """Write it down, again and again where the database cannot be written to; it has taken minutes to find.

        Where the console ends before that, the next start says that it was interrupted.
        """
        while True:
            last = self._ending.is_set()
            try:
                return write()
            except OperationalError as error:
                _log.warning("identification %d cannot be written down yet: %s", number, error)
            if last:
                return
            self._ending.wait(AGAIN_S)
