"""A run's responses and their conductor, on the virtual rig as on the real one."""

import numpy as np

from app.analysis.response.point import ResponsePoint
from app.analysis.response.transfers import MOTION_TRANSFERS
from app.analysis.walk import POSITION, Columns
from app.conducting.conductor import MEASURED, Conductor
from app.conducting.positions import multisines_in
from app.conducting.responding import Responding, responses_in
from app.conducting.score import scores_of
from app.definitions.definition import Definition
from app.definitions.outline import outline
from app.definitions.responses import FrequencyResponse
from rtcore.modes import Mode
from rtcore.rig.parameters import RigParameters

COUNTED = {MEASURED, *MOTION_TRANSFERS}  # of which each point is one that was asked for
LOOK_TICKS = 80  # 20 ms: how often it is decided what to leave out


class Conducting:
    """Takes a run as it goes by; says what to skip, and which points there are."""

    def __init__(
        self,
        definition: Definition,
        period_s: float,
        first_tick: int | None = None,
        rig: RigParameters | None = None,
    ) -> None:
        """`first_tick` and `rig` as of `Responding`."""
        scores = scores_of(definition)
        self.adapts = bool(scores)
        self.responding = Responding(definition, period_s, first_tick, rig)
        self._conductor = Conductor(scores, period_s)
        self._period_s = period_s
        self._ticks = sum(block.duration_s for block in outline(definition).blocks) / period_s
        self._expected = sum(_points_of(asked) for asked in responses_in(definition))
        self._expected += sum(len(m.grid().lines) for m in multisines_in(definition).values())
        self._played = 0  # ticks in which the program went on
        self._position = 0

    def take(self, chunk: Columns) -> int | None:
        """The next ticks, with the columns `responding.NEEDS`; the segment to skip to now, if any."""
        self.responding.take(chunk, self._conductor.take)
        self._note(chunk)
        goes_on = len(chunk["mode"]) > 0 and chunk["mode"][-1] == Mode.RUNNING
        return self._conductor.wanted(self._latest) if self.adapts and goes_on else None

    def progress(self) -> tuple[int, int, float | None]:
        """Points so far, of how many expected, and seconds left at the pace so far."""
        points = {f.point[:5] for f in self.responding.points() if f.point.transfer in COUNTED}
        left_ticks = max(0.0, self._ticks - self._position)
        pace = self._played / self._position if self._position else 1.0
        seconds_left = left_ticks * pace * self._period_s
        return len(points), max(self._expected, len(points)), seconds_left

    def _note(self, chunk: Columns) -> None:
        """How far the program is, and how long that has taken."""
        told = chunk[POSITION]
        if len(told) and told[-1] >= 0:
            self._played += int(np.count_nonzero(np.diff(told, prepend=self._position)))
            self._position = int(told[-1])

    def _latest(self) -> list[ResponsePoint]:
        return [found.point for found in self.responding.latest()]


def _points_of(asked: FrequencyResponse) -> int:
    """Those that are measured in any case."""
    frequencies = asked.frequencies() if asked.method == "stepped_sine" else asked.grid().lines
    return len(asked.means()) * len(asked.amplitudes_n) * len(frequencies)
