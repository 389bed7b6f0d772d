"""The cubic curve through evenly spaced samples: monotone between knots, so that it overshoots none.

Slopes are those of Fritsch and Carlson as Butland weights them (scipy's PCHIP); a slope is the change of value in
one interval. Samples are read piece by piece: a day of them is never in memory at once.
"""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

CHUNK = 1 << 16
LARGEST = 1e15  # N or m: the squares of what is larger may be no numbers any more

Values = npt.NDArray[np.float64]


def pieces(
    values: Values, begin: int = 0, chunk: int = CHUNK
) -> Iterator[tuple[int, Values, Values]]:
    """Samples and slopes from one on: (index of the first, (k,) values, (k,) slopes) after another."""
    for first in range(begin, len(values), chunk):
        last = min(first + chunk, len(values))
        yield first, np.array(values[first:last], np.float64), slopes(values, first, last)


def slopes(values: Values, first: int, last: int) -> Values:
    """The slopes at samples `first` to before `last`, (last - first,). Needs two samples at least."""
    count = len(values)
    begin, end = max(first - 1, 0), min(last + 1, count)
    begin = min(begin, max(count - 3, 0)) if last == count else begin
    end = max(end, min(3, count)) if first == 0 else end
    steps = np.diff(np.asarray(values[begin:end], np.float64))
    found = np.zeros(end - begin)
    found[1:-1] = _between(steps[:-1], steps[1:])
    if begin == 0:
        found[0] = _at_end(steps[0], steps[min(1, len(steps) - 1)])
    if end == count:
        found[-1] = _at_end(steps[-1], steps[max(len(steps) - 2, 0)])
    return found[first - begin : last - begin]


def steepest(values: Values, slopes: Values) -> Values:
    """The steepest change on each interval of the curve, (n - 1,), in units of value an interval."""
    step, before, after = np.diff(values), slopes[:-1], slopes[1:]
    # The slope within an interval is a parabola: it is greatest at an end or at the vertex.
    linear = 6 * step - 4 * before - 2 * after
    square = 3 * (before + after - 2 * step)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = -linear / (2 * square)
        vertex = np.where((place > 0) & (place < 1), before - linear**2 / (4 * square), 0.0)
    return np.asarray(np.maximum(np.maximum(np.abs(before), np.abs(after)), np.abs(vertex)))


def _between(before: Values, after: Values) -> Values:
    """The harmonic mean of the steps on both sides; flat where the curve turns."""
    same = before * after > 0
    total = np.where(same, before + after, 1.0)
    return np.where(same, 2 * before * (after / total), 0.0)


def _at_end(near: float, beyond: float) -> float:
    """The slope at an end, from the step beside it and the one beyond."""
    slope = (3 * near - beyond) / 2
    if slope * near <= 0:
        return 0.0
    if near * beyond <= 0 and abs(slope) > 3 * abs(near):
        return 3 * near
    return slope
