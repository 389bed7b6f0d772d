"""The points of a stepped sine in the order in which they may be played: every one that may be needed.

Frequencies between two others come as soon as those on both sides of the two are known, for only then it is
known whether the response bends there. Lower levels of a point come right after it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from app.definitions.adaptive import AutoResolution
from app.definitions.pieces import Sine
from app.definitions.responses import FrequencyResponse


@dataclass(frozen=True)
class PlannedPoint:
    """A sine that may be measured.

    `series` counts means and amplitudes, `place` frequencies within one: that of a point `between` two is the
    first of the two. `rank` is its place among those between. `level` halves the amplitude so many times.
    `slower_hz` is the slowest of it and of those that may be played right before it.
    """

    sine: Sine
    series: int
    place: int
    rank: int
    level: int
    slower_hz: float

    @property
    def between(self) -> bool:
        """Whether it is only played where the response bends."""
        return self.rank > 0


def planned_points(block: FrequencyResponse) -> list[PlannedPoint]:
    """All of a stepped sine."""
    levels = (1.0,) if block.auto_level is None else block.auto_level.shares()
    frequencies = list(_ordered(block.frequencies(), block.auto_resolution))
    found: list[PlannedPoint] = []
    reachable: list[float] = []  # back to the last frequency that is played in any case
    series = [(mean, amplitude) for mean in block.means() for amplitude in block.amplitudes_n]
    for number, (mean_n, amplitude_n) in enumerate(series):
        asked_n = None if block.auto_level is None else amplitude_n
        for place, rank, hz in frequencies:
            slower_hz = min([hz, *reachable])
            for level, share in enumerate(levels):
                sine = Sine(mean_n, amplitude_n * share, hz, asked_n)
                found.append(PlannedPoint(sine, number, place, rank, level, slower_hz))
            reachable = [hz] if rank == 0 else [*reachable, hz]
    return found


def slowest_at_end(points: Sequence[PlannedPoint]) -> float:
    """The slowest frequency (Hz) of those that may be the last to be played."""
    last = next(i for i in reversed(range(len(points))) if not points[i].between)
    return min(point.sine.frequency_hz for point in points[last:])


def _ordered(
    frequencies_hz: Sequence[float], resolution: AutoResolution | None
) -> Iterator[tuple[int, int, float]]:
    """Place, rank and frequency, in playing order."""
    last = len(frequencies_hz) - 1
    for place, hz in enumerate(frequencies_hz):
        yield place, 0, hz
        if resolution is not None and place >= 2:
            yield from _between(frequencies_hz, place - 2, resolution.points)
    if resolution is not None and last >= 2:
        yield from _between(frequencies_hz, last - 1, resolution.points)


def _between(
    frequencies_hz: Sequence[float], place: int, points: int
) -> Iterator[tuple[int, int, float]]:
    low, high = frequencies_hz[place], frequencies_hz[place + 1]
    inner = np.geomspace(low, high, points + 2)[1:-1]
    yield from ((place, rank, float(hz)) for rank, hz in enumerate(inner, start=1))
