"""The keeper: a thread of its own that follows the loop and keeps each first-out, whatever else is going on."""

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from queue import SimpleQueue
from threading import Event, Thread

import numpy as np
from sqlalchemy.exc import SQLAlchemyError

from app.first_outs.book import Book
from app.first_outs.box import Box, InForce, fill_box, last_tick
from app.first_outs.files import set_down
from app.first_outs.noticing import Noticed, Noticer
from app.link.life import Life

_log = logging.getLogger(__name__)
LOOK_S = 0.1
MOST_IN_MEMORY = 20  # boxes that a full disk does not take: of more, only the account is kept
ATTEMPTS_AT_THE_END = 5
RETRY_S = 1.0


class Following:
    """What is noticed in one life of the loop, until its box is full."""

    def __init__(self, life: Life, book: Book) -> None:
        self.life = life
        self._book = book
        self._noticer = Noticer(life.period_ns * 1e-9)
        self._events = life.events()
        self._held_back = np.empty(0, self._events.ring.dtype)
        self._noticed: deque[tuple[Noticed, InForce]] = deque()

    def look(self, in_force: InForce) -> list[Box]:
        """Read on; the boxes that are full now. Where the loop has died, those that never will be, too."""
        ended, newest = self.life.ended, self.life.next_tick()
        events = np.concatenate([self._held_back, self._events.read().records])
        ready = np.ones(len(events), np.bool_) if ended else events["tick"] < newest
        self._held_back = events[~ready]
        found = self._noticer.take(events[ready], self.life.detectors())
        self._noticed.extend((noticed, in_force) for noticed in found)
        boxes = []
        while self._noticed and (ended or last_tick(self._noticed[0][0], self.life) < newest):
            noticed, then = self._noticed.popleft()
            if not self._is_kept(noticed.tick):
                reported = self.life.events().read().records
                boxes.append(fill_box(self.life, noticed, reported, then))
        return boxes

    def _is_kept(self, tick: int) -> bool:
        """Kept by an earlier start; where the database does not answer now, entering it will tell."""
        try:
            return self._book.knows(self.life.name, tick)
        except SQLAlchemyError:
            return False

    @property
    def waits(self) -> bool:
        """Whether something has been noticed that is not full yet."""
        return bool(self._noticed)


class Keeper:
    """Follows one life of the loop after the other, each to its end."""

    def __init__(self, book: Book, in_force: Callable[[], InForce]) -> None:
        self._book = book
        self._in_force = in_force
        self._lives: SimpleQueue[Life | None] = SimpleQueue()
        self._boxes: deque[Box] = deque()
        self._ended = Event()
        self._thread = Thread(target=self._run, name="first-outs", daemon=True)
        self._caught_up = False
        self.trouble: str | None = None

    def start(self) -> None:
        """Begin to follow."""
        self._thread.start()

    def follow(self, life: Life) -> None:
        """Follow this life once the one before it has ended. Returns at once."""
        self._lives.put(life)

    def stop(self) -> None:
        """Keep what the ended life still holds, then end the thread."""
        self._ended.set()
        self._lives.put(None)
        self._thread.join()

    def _run(self) -> None:
        while (life := self._lives.get()) is not None:
            try:
                self._follow(life)
            except Exception:
                _log.exception("the first-outs of the life %s of the loop", life.name)
        attempts = 0
        while self._boxes and attempts < ATTEMPTS_AT_THE_END:
            attempts += not self._keep()
            Event().wait(RETRY_S if self._boxes else 0.0)

    def _follow(self, life: Life) -> None:
        following = Following(life, self._book)
        while True:
            last = life.ended
            self.look(following)
            if last and not following.waits:
                return
            if self._ended.wait(LOOK_S) and not life.ended:
                return  # the loop outlives this console: the next one catches up

    def look(self, following: Following) -> None:
        """Read on in a life, and keep what is full; what cannot be kept now is tried again by the next."""
        self._tried(lambda: self._read(following))
        self._keep()

    def _read(self, following: Following) -> None:
        for box in following.look(self._in_force()):
            full = len(self._boxes) >= MOST_IN_MEMORY
            self._boxes.append(replace(box, records=box.records[:0]) if full else box)

    def _keep(self) -> bool:
        """Set down and enter the boxes in memory; False where the disk or the database does not take one.

        What an earlier start has left comes first: a life's first-outs are entered in order.
        """
        self._caught_up = self._caught_up or self._tried(self._book.catch_up)
        if not self._caught_up:
            return False
        while self._boxes:
            if not self._tried(self._keep_oldest):
                return False
            self._boxes.popleft()
        return True

    def _keep_oldest(self) -> None:
        self._book.enter(set_down(self._book.folder, self._boxes[0]))

    def _tried(self, job: Callable[[], object]) -> bool:
        try:
            job()
        except (OSError, SQLAlchemyError) as error:
            if self.trouble is None:
                _log.exception("a first-out could not be kept; trying again")
            self.trouble = getattr(error, "strerror", None) or "the database does not answer"
            return False
        self.trouble = None
        return True
