"""Runs laid over each other tick by tick: least and greatest in bins, and where they differ.

Everything is taken tick against tick and only then put into bins, so that no peak and no difference is lost
however many ticks a bin has; where there are few ticks, each is a bin of its own.
"""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
MOST_INTERVALS = 200  # that are told; all are counted


class Tolerance(NamedTuple):
    """What a difference may be: the larger of an absolute one and a share of the baseline's value."""

    absolute: float
    relative: float = 0.0

    def around(self, baseline: Floats) -> Floats:
        """(n,) the tolerance at each value of the baseline."""
        return np.maximum(self.absolute, self.relative * np.abs(baseline))

    def at(self, baseline: float) -> float:
        """The tolerance at one value of the baseline."""
        return max(self.absolute, self.relative * abs(baseline))


class Interval(NamedTuple):
    """Where a difference exceeds its tolerance, both ends in it, and the largest difference there.

    NaN where none of its differences is a number.
    """

    first: int
    last: int
    peak: float


class Band:
    """Least and greatest of a signal in bins of equal width, filled piece by piece in order."""

    def __init__(self, bins: int, width: int) -> None:
        self._width = width
        self.low = np.full(bins, np.nan)
        self.high = np.full(bins, np.nan)

    def take(self, first: int, values: Floats) -> None:
        """(n,) values from the place `first` on; NaN where there is none."""
        begins = np.arange(-(first % self._width), len(values), self._width).clip(min=0)
        at = first // self._width + np.arange(len(begins))
        self.low[at] = np.fmin(self.low[at], np.fmin.reduceat(values, begins))
        self.high[at] = np.fmax(self.high[at], np.fmax.reduceat(values, begins))


class Exceeding:
    """Gathers where something is exceeded; interruptions up to `joined` places do not part an interval."""

    def __init__(self, joined: int = 0) -> None:
        self._joined = joined
        self._open: Interval | None = None
        self.intervals: list[Interval] = []
        self.count = 0  # of intervals
        self.places = 0  # that exceed

    def take(self, first: int, exceeds: Bools, by: Floats) -> None:
        """(n,) whether each place from `first` on exceeds, and its difference; NaN where it has none."""
        self.places += int(np.count_nonzero(exceeds))
        edges = np.flatnonzero(np.diff(exceeds.astype(np.int8), prepend=0, append=0))
        for low, high in edges.reshape(-1, 2).tolist():
            self._add(Interval(first + low, first + high - 1, _largest(by[low:high])))

    def close(self) -> None:
        """Nothing comes after."""
        last, self._open = self._open, None
        if last is not None:
            self.count += 1
            if len(self.intervals) < MOST_INTERVALS:
                self.intervals.append(last)

    def _add(self, fresh: Interval) -> None:
        now = self._open
        if now is None or fresh.first - now.last - 1 > self._joined:
            self.close()
            self._open = fresh
            return
        peak = _largest(np.array([now.peak, fresh.peak]))
        self._open = Interval(now.first, fresh.last, peak)


class Difference:
    """A run less the baseline, of one channel, piece by piece."""

    def __init__(self, bins: int, width: int, tolerance: Tolerance | None) -> None:
        self.band = Band(bins, width)
        self.tolerances = np.full(bins, np.nan)  # the least in each bin
        self.exceeding = Exceeding(joined=width)
        self.count = 0  # of places that have a number in both
        self.one_sided = 0  # places, recorded in both, that have a number in one alone
        self.peak: float | None = None  # as `peak_at`, None while there is no place to compare
        self.peak_at: int | None = None
        self._tolerance = tolerance
        self._limits = Band(bins, width)
        self._squares = 0.0

    def take(self, first: int, baseline: Floats, values: Floats, recorded: Bools) -> None:
        """(n,) of both from the place `first` on; NaN where there is none, and whether both were recorded.

        A place that was recorded in both and is a number in one alone exceeds whatever tolerance.
        """
        numbers = np.isfinite(baseline), np.isfinite(values)
        there = numbers[0] & numbers[1]
        one_sided = recorded & (numbers[0] ^ numbers[1])
        apart = np.subtract(values, baseline, np.full(len(values), np.nan), where=there)
        self.band.take(first, apart)
        self.count += int(np.count_nonzero(there))
        self.one_sided += int(np.count_nonzero(one_sided))
        self._squares += float(np.sum(apart * apart, where=there))
        self._find_peak(first, apart)
        if self._tolerance is not None:
            limits = self._tolerance.around(baseline)
            self._limits.take(first, limits)
            over = np.greater(np.abs(apart), limits, np.zeros(len(apart), np.bool_), where=there)
            self.exceeding.take(first, over | one_sided, apart)

    def close(self) -> None:
        """Nothing comes after."""
        self.exceeding.close()
        self.tolerances = self._limits.low

    @property
    def rms(self) -> float | None:
        """None where there is no place that both have."""
        return math.sqrt(self._squares / self.count) if self.count else None

    @property
    def exceeded_share(self) -> float | None:
        """Of the places that can be judged; None where there is none, or no tolerance."""
        judged = self.count + self.one_sided
        return None if self._tolerance is None or not judged else self.exceeding.places / judged

    def _find_peak(self, first: int, apart: Floats) -> None:
        found = _largest(apart)
        if np.isfinite(found) and (self.peak is None or abs(found) > abs(self.peak)):
            self.peak, self.peak_at = found, first + int(np.flatnonzero(apart == found)[0])


def _largest(values: Floats) -> float:
    """The one furthest from zero; NaN where none is a number."""
    sizes = np.where(np.isfinite(values), np.abs(values), -1.0)
    return float(values[np.argmax(sizes)]) if len(values) else math.nan


def bin_width(places: int, points: int) -> int:
    """Places a bin, so that no more than `points` bins hold them all."""
    return max(1, -(-places // max(1, points)))


def put(values: npt.NDArray[Any], places: npt.NDArray[Any], fresh: npt.NDArray[Any]) -> None:
    """Put (m,) fresh values into (n,) at their places, those outside left out."""
    inside = (places >= 0) & (places < len(values))
    values[places[inside]] = fresh[inside]
