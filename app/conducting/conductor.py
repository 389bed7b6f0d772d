"""Decides which part of an adaptive frequency response is left out, from what has been measured so far.

It knows no clock and no rig: parts of the run go in, segments to skip to come out. So it conducts the virtual
rig as it does the real one.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from app.analysis.response.point import ResponsePoint
from app.analysis.walk import Part
from app.conducting.bending import Answer, bends_between
from app.conducting.score import Role, Score, Turn
from app.conducting.settled import CycleByCycle
from app.definitions.adaptive import AutoLevel, Confidence

LEAST_CYCLES = 4  # of which an interval says something
ROOM = 0.8  # of a limit: a level is raised only where it would stay below that
MEASURED = "force"  # the transfer that all is decided by


@dataclass
class _Heights:
    """How far valve and unit went at the present level, either way."""

    valve: float = 0.0
    displacement_m: float = 0.0

    def see(self, part: Part) -> None:
        self.valve = max(self.valve, float(np.abs(part.columns["valve_command"]).max()))
        moved_m = float(np.abs(part.columns["displacement_m"]).max())
        self.displacement_m = max(self.displacement_m, moved_m)

    def times(self, factor: float) -> "_Heights":
        return _Heights(self.valve * factor, self.displacement_m * factor)

    def within(self, limits: AutoLevel) -> bool:
        most_m = limits.displacement_at_most_m
        return self.valve <= limits.valve_at_most and (
            most_m is None or self.displacement_m <= most_m
        )


@dataclass
class _Series:
    """What is known of one mean and amplitude: the level it is at, and the answers at its frequencies."""

    level: int = 0
    answers: dict[int, Answer] = field(default_factory=dict)


class _OfBlock:
    """The conductor of one block."""

    def __init__(self, score: Score, period_s: float) -> None:
        self._score = score
        self._period_s = period_s
        self._turns = {turn.first: turn for turn in score.turns}
        self._at: Turn | None = None
        self._done: set[tuple[int, int, int]] = set()  # series, place and rank that are measured
        self._series: dict[int, _Series] = {}
        self._given_up: set[int] = set()  # points that were too high
        self._heights = _Heights()
        self._settling: CycleByCycle | None = None

    def take(self, part: Part) -> None:
        """The next part of the block."""
        turn = self._turns[part.stretch.first]
        if self._at is not turn:
            self._enter(turn)
        if turn.role is Role.OUT:
            return
        if turn.role is not Role.BLEND or self._swings(turn, part):
            self._heights.see(part)
        if self._settling is not None:
            self._settling.take(part)

    def wanted(self, latest: ResponsePoint | None) -> int | None:
        """The segment to skip to now; `latest` is what there is of the point that is being measured."""
        turn = self._at
        if turn is None or turn.role is Role.OUT:
            return None
        if not self._is_needed(turn.point):
            return self._blend_of_next(turn.point)
        if turn.role is Role.MEASURE and latest is not None and latest.cycles > 0:
            self._answer(turn.point, latest)
        if self._is_too_high(turn):
            self._series_of(turn.point).level += 1
            self._given_up.add(turn.point)
            return self._blend_of_next(turn.point)
        if turn.role is Role.SETTLE and self._settling is not None and self._settling.is_steady:
            return self._score.segment_of(turn.point, Role.MEASURE)
        if turn.role is Role.MEASURE and self._is_sure(latest):
            self._leave(turn.point)
            return self._blend_of_next(turn.point)
        return None

    def progress(self) -> tuple[int, int]:
        """How many points are measured, and how many are expected in all."""
        base = {(p.series, p.place, p.rank) for p in self._score.points if not p.between}
        return len(self._done), len(base | self._done)

    def _enter(self, turn: Turn) -> None:
        before, self._at = self._at, turn
        if before is not None and before.role is Role.MEASURE and before.point != turn.point:
            self._leave(before.point)
        if before is None or before.point != turn.point:
            self._heights = _Heights()
        asked = self._score.asked
        self._settling = None
        if turn.role is Role.SETTLE and asked.settle is not None:
            hz = self._score.points[turn.point].sine.frequency_hz
            self._settling = CycleByCycle(hz * self._period_s, asked.settle_cycles)

    def _leave(self, point: int) -> None:
        """A point is measured: those at its place are not needed any more."""
        planned, limits = self._score.points[point], self._score.asked.auto_level
        place = planned.series, planned.place, planned.rank
        if point in self._given_up or place in self._done:
            return
        self._done.add(place)
        series = self._series_of(point)
        if limits is not None and series.level > 0:
            raised = self._heights.times(2.0 / ROOM)
            series.level -= raised.within(limits)

    def _answer(self, point: int, latest: ResponsePoint) -> None:
        planned = self._score.points[point]
        if not planned.between:
            self._series_of(point).answers[planned.place] = Answer(
                planned.sine.frequency_hz, latest.gain, latest.phase_deg
            )

    def _is_needed(self, point: int) -> bool:
        if point >= len(self._score.points):
            return True
        planned, series = self._score.points[point], self._series_of(point)
        if (planned.series, planned.place, planned.rank) in self._done:
            return False
        if planned.level < series.level:
            return False
        resolution = self._score.asked.auto_resolution
        if not planned.between or resolution is None:
            return True
        return bends_between(series.answers, planned.place, resolution)

    def _blend_of_next(self, point: int) -> int:
        following = point + 1
        while not self._is_needed(following):
            following += 1
        return self._score.segment_of(following, Role.BLEND)

    def _is_too_high(self, turn: Turn) -> bool:
        limits = self._score.asked.auto_level
        if limits is None or self._heights.within(limits):
            return False
        return self._score.points[turn.point].level + 1 < len(limits.shares())

    def _is_sure(self, latest: ResponsePoint | None) -> bool:
        asked = self._score.asked.confidence
        return asked is not None and latest is not None and is_sure(latest, asked)

    def _series_of(self, point: int) -> _Series:
        return self._series.setdefault(self._score.points[point].series, _Series())

    def _swings(self, turn: Turn, part: Part) -> bool:
        """Whether a blend is so far on that what it reaches is its own point's doing."""
        return 2 * (int(part.positions[0]) - turn.first) >= turn.last - turn.first


def is_sure(point: ResponsePoint, asked: Confidence) -> bool:
    """Whether a point is settled and its 95 % interval within what was asked for."""
    low, high = point.gain_95
    if (
        not point.settled
        or point.cycles < LEAST_CYCLES
        or not 0 < low <= point.gain
        or not math.isfinite(high)
    ):
        return False
    wide_db = max(_db(high / point.gain), _db(point.gain / low))
    wide_deg = 0.5 * (point.phase_95_deg.high - point.phase_95_deg.low)
    return wide_db <= asked.gain_db and wide_deg <= asked.phase_deg


def _db(ratio: float) -> float:
    return 20 * math.log10(ratio)


class Conductor:
    """Conducts every adaptive frequency response of a test."""

    def __init__(self, scores: Sequence[Score], period_s: float) -> None:
        self._blocks = {score.block: _OfBlock(score, period_s) for score in scores}
        self._now: _OfBlock | None = None

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever block."""
        self._now = self._blocks.get(part.stretch.block)
        if self._now is not None:
            self._now.take(part)

    def wanted(self, latest: Callable[[], Sequence[ResponsePoint]]) -> int | None:
        """The segment of the force course to skip to now; `latest` gives what is being measured."""
        if self._now is None:
            return None
        point = next((p for p in latest() if p.transfer == MEASURED), None)
        return self._now.wanted(point)
