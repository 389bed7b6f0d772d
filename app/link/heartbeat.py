"""The app's heartbeat: neither a busy event loop nor a busy interpreter stops the load; a dead or hung one does."""

import logging
import os
from threading import Event, Thread

from app.link.life import Life
from rtcore.memory.heartbeat import PERIOD_NS, Beater

_log = logging.getLogger(__name__)
_PRIORITY = 1  # the least of real time: it takes a microsecond of twenty milliseconds


class Heartbeat:
    """Tells the loop that the app is there. Silent for 0.5 s, and the loop takes the load off.

    One thread beats without the interpreter, another shows that the interpreter goes on.
    """

    def __init__(self) -> None:
        self._beater = Beater()
        self._ended = Event()
        self._threads = (
            Thread(target=self._beat, name="heartbeat", daemon=True),
            Thread(target=self._show, name="interpreter", daemon=True),
        )

    def start(self) -> None:
        """Begin to beat."""
        for thread in self._threads:
            thread.start()

    def turn_to(self, life: Life | None) -> None:
        """Beat in the block of this life from now on, its first beat being done at once."""
        self._beater.turn_to(None if life is None else life.block)

    def stop(self) -> None:
        """Fall silent."""
        self._ended.set()
        self._beater.end()
        for thread in self._threads:
            if thread.is_alive():
                thread.join()

    def _beat(self) -> None:
        try:
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(_PRIORITY))
        except OSError as error:
            _log.info("the heartbeat has no real-time priority: %s", error.strerror)
        self._beater.keep_beating()

    def _show(self) -> None:
        while not self._ended.wait(PERIOD_NS * 1e-9):
            self._beater.show()
