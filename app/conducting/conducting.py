"""A run's responses and their conductor, on the virtual rig as on the real one."""

from app.analysis.response.point import ResponsePoint
from app.analysis.walk import Columns
from app.conducting.conductor import Conductor
from app.conducting.responding import Responding
from app.conducting.score import scores_of
from app.definitions.definition import Definition

LOOK_TICKS = 80  # 20 ms: how often it is decided what to leave out


class Conducting:
    """Takes a run as it goes by; says what to skip, and which points there are."""

    def __init__(
        self, definition: Definition, period_s: float, first_tick: int | None = None
    ) -> None:
        scores = scores_of(definition)
        self.adapts = bool(scores)
        self.responding = Responding(definition, period_s, first_tick)
        self._conductor = Conductor(scores, period_s)

    def take(self, chunk: Columns) -> int | None:
        """The next ticks, with the columns `responding.NEEDS`; the segment to skip to now, if any."""
        self.responding.take(chunk, self._conductor.take)
        return self._conductor.wanted(self._latest) if self.adapts else None

    def _latest(self) -> list[ResponsePoint]:
        return [found.point for found in self.responding.latest()]
