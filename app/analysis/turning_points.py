"""Turning points of a signal: where it turns round by more than a gate, chunk after chunk."""

import math
from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt

from rtcore.compiled import entry

Floats = npt.NDArray[np.float64]

_AT = np.dtype(
    [
        ("begun", "?"),
        ("direction", "i8"),  # +1 rising, -1 falling, 0 not known yet
        ("low", "f8"),  # least and greatest so far; once a direction is known, one of them is
        ("high", "f8"),  # the extreme that is going to be the next turning point
        ("lost", "i8"),  # samples that were no number
    ]
)


class TurningPoints:
    """Peaks and valleys in turn, the first and the last included; memory does not grow.

    A range below the gate is noise and turns nothing: what turns back sooner is left out, and the extremes
    that remain are those of the signal itself. With a gate of 0 every change of direction counts.
    """

    def __init__(self, gate: float = 0.0) -> None:
        """Raises ValueError where the gate is no range."""
        if not gate >= 0 or math.isinf(gate):
            raise ValueError(f"a gate of {gate:g} is no range")
        self._gate = gate
        self._at = np.zeros(1, _AT)

    @property
    def lost(self) -> int:
        """How many samples were no number: they are passed over."""
        return int(self._at[0]["lost"])

    def take(self, values: npt.NDArray[np.floating]) -> Floats:
        """(n,) turning points that are certain with the next samples (n,)."""
        samples = np.require(values, np.float64, ["C", "W"])
        found = np.empty(len(samples) + 1)
        return found[: _turns(self._at, samples, self._gate, found)]

    def close(self) -> Floats:
        """(0 or 1,) the last one: where the signal was on its way to."""
        at = self._at[0]
        if at["direction"] == 0:
            return np.zeros(0)
        return np.array([at["high"] if at["direction"] > 0 else at["low"]])


def turning_points(
    chunks: Iterable[npt.NDArray[np.floating]], gate: float = 0.0
) -> Iterator[float]:
    """The turning points of a signal that comes in chunks, one after another."""
    turning = TurningPoints(gate)
    for chunk in chunks:
        yield from turning.take(chunk).tolist()
    yield from turning.close().tolist()


@entry
def _turns(state: npt.NDArray[np.void], values: Floats, gate: float, found: Floats) -> int:
    """Fill in turning points; how many."""
    at = state[0]
    count = 0
    for value in values:
        if np.isnan(value):
            at.lost += 1
            continue
        if not at.begun:
            at.begun = True
            at.low = at.high = value
        if at.direction >= 0 and value > at.high:
            at.high = value
        if at.direction <= 0 and value < at.low:
            at.low = value
        falls = value < at.high and at.high - value >= gate and at.direction >= 0
        rises = value > at.low and value - at.low >= gate and at.direction <= 0
        if falls:
            found[count] = at.high
            count += 1
            at.direction = -1
            at.low = value
        elif rises:
            found[count] = at.low
            count += 1
            at.direction = 1
            at.high = value
    return count
