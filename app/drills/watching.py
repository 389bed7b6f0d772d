"""Watches a drill: a thread that follows the loop from the fault until everything has been seen."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from threading import Event, Thread
from typing import Any

import numpy as np
import numpy.typing as npt

from app.drills.drills import Drill, Reaction
from app.drills.scoring import LEAD_S, Seen, is_over
from app.link.life import Life
from rtcore.modes import Mode

Records = npt.NDArray[Any]
LOOK_S = 0.05


@dataclass(frozen=True)
class Given:
    """A drill that the loop has taken."""

    number: int
    drill: Drill
    reaction: Reaction
    tick: int
    mode: Mode
    life: Life
    names: Sequence[str]  # of the detectors in force


@dataclass(frozen=True)
class Watched:
    """What was seen of it; `samples` begin `LEAD_S` before the fault."""

    seen: Seen
    samples: Records


class Watch:
    """One drill under way. `ended` is told what was seen, or why it was interrupted, from its thread."""

    def __init__(self, given: Given, ended: Callable[["Watch", Watched | str], None]) -> None:
        self.given = given
        self._ended = ended
        self._stopped = Event()
        self._why = ""
        self._events = given.life.events()
        self._reported: list[Records] = []
        self._thread = Thread(target=self._watch, name="drill", daemon=True)

    def start(self) -> None:
        """Begin to watch."""
        self._thread.start()

    def interrupt(self, why: str) -> None:
        """End it without a score, and wait until that is written down."""
        self._why = why
        self._stopped.set()
        self._thread.join()

    def _watch(self) -> None:
        self._ended(self, self._until_over())

    def _until_over(self) -> Watched | str:
        given = self.given
        while True:
            if not given.life.alive:
                return "The loop ended in the middle of it"
            newest = given.life.next_tick() - 1
            if is_over(given.reaction, self._seen(np.empty(0)), newest):
                return self._watched(newest)
            if self._stopped.wait(LOOK_S):
                return self._why

    def _seen(self, records: Records) -> Seen:
        given = self.given
        self._reported.append(self._events.read().records)
        events = np.concatenate(self._reported)
        self._reported = [events[events["tick"] >= given.tick]]
        detectors = given.life.detectors()
        return Seen(
            tick=given.tick,
            mode=given.mode,
            period_s=given.life.period_ns * 1e-9,
            records=records,
            events=self._reported[0],
            detectors=detectors,
            names=given.names,
        )

    def _watched(self, newest: int) -> Watched:
        """What the ring holds of it: a minute, and no drill is that long."""
        life, tick = self.given.life, self.given.tick
        first = max(0, tick - round(LEAD_S * 1e9 / life.period_ns))
        reader = life.telemetry(life.position_of(first))
        samples = reader.read(newest - first + 1).records
        return Watched(self._seen(samples[samples["tick"] >= tick]), samples)
