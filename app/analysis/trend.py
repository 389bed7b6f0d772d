"""A straight line through values over time, and whether it leans."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.special import stdtrit

CONFIDENCE = 0.95
LEAST_POINTS = 3  # of two the line is certain, and means nothing


class Line(NamedTuple):
    """By least squares. The slope's truth lies from `slope_low` to `slope_high` in 95 of 100 cases.

    `first` and `last` are the line's values at the earliest and the latest point, `deviation` is that of
    the values about it.
    """

    slope: float
    slope_low: float
    slope_high: float
    first: float
    last: float
    deviation: float

    @property
    def leans(self) -> bool:
        """Whether a slope of zero is out of the interval."""
        return not self.slope_low <= 0.0 <= self.slope_high


def trend(at: Sequence[float], values: Sequence[float]) -> Line | None:
    """The line through (n,) values; None of fewer than three, or where all are at one time."""
    x, y = np.asarray(at, np.float64), np.asarray(values, np.float64)
    if len(x) < LEAST_POINTS or not np.ptp(x) > 0:
        return None
    apart = x - x.mean()
    squares = float(np.dot(apart, apart))
    slope = float(np.dot(apart, y - y.mean())) / squares
    line = y.mean() + slope * apart
    freedom = len(x) - 2
    deviation = math.sqrt(float(np.sum((y - line) ** 2)) / freedom)
    reach = float(stdtrit(freedom, 0.5 + 0.5 * CONFIDENCE)) * deviation / math.sqrt(squares)
    first, last = float(line[np.argmin(x)]), float(line[np.argmax(x)])
    return Line(slope, slope - reach, slope + reach, first, last, deviation)
