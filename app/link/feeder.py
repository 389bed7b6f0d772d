"""Feeds a streamed program to the loop while it plays it."""

import logging
from threading import Event, Thread

from app.link.life import Life
from rtcore.memory.playing import read_playing
from rtcore.program.stream import ProgramWriter

_log = logging.getLogger(__name__)
PERIOD_S = 0.05  # the rings hold a second of the shortest segments, and 16 s of knots


class Feeder:
    """A thread that writes on as the loop plays, from the adoption of a program to its last record.

    Where it fails the loop takes the load off: a program that does not come is a fault of its own.
    """

    def __init__(self, life: Life, writer: ProgramWriter) -> None:
        self._life = life
        self._writer = writer
        self._ended = Event()
        self._thread = Thread(target=self._feed, name="feeder", daemon=True)

    def start(self) -> None:
        """Begin to feed, where not all of the program fitted into its bank."""
        if self._writer.streaming:
            self._thread.start()

    def stop(self) -> None:
        """Feed no longer: another program takes its place, or the console ends."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _feed(self) -> None:
        try:
            while not (self._ended.wait(PERIOD_S) or self._life.ended):
                playing = read_playing(self._life.block)
                if playing is not None and not self._writer.fill(playing):
                    return
        except Exception:
            _log.exception("the program cannot be streamed on: the loop takes the load off")
