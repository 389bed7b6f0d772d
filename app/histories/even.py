"""From times as they were written to an even rate: taken as even where they nearly are, resampled where not."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from app.documents.units import say
from app.histories.curve import CHUNK, Values
from app.histories.layout import Unreadable

NEARLY = 0.05  # of an interval that a time may lie beside the even grid
LONGEST_GAP = 10.0  # intervals; beyond that the record is not uneven but broken off
MOST_SAMPLES = 2_000_000_000
_KNOTS_BESIDE = 3  # so that the slopes on a stretch are those of the whole curve

LineOf = Callable[[int], int]  # the line of a sample in its file


def rate_of(times: Values, line_of: LineOf) -> tuple[float, bool]:
    """The rate of (n,) times in Hz, n ≥ 2, and whether they are even. Raises `Unreadable`."""
    _refuse_backwards(times, line_of)
    count = len(times)
    interval_s = float(times[-1] - times[0]) / (count - 1)
    beside = max(
        float(np.abs(times[i : i + CHUNK] - times[0] - interval_s * np.arange(i, j)).max())
        for i, j in _stretches(count)
    )
    if beside <= NEARLY * interval_s:
        return _tidy(1 / interval_s), True
    usual_s = float(np.median(np.diff(times[: 16 * CHUNK])))
    _refuse_gaps(times, usual_s, line_of)
    return _tidy(1 / usual_s), False


def count_at(times: Values, rate_hz: float) -> int:
    """How many samples at a rate fit between the first and the last time. Raises `Unreadable`."""
    duration_s = float(times[-1] - times[0])
    count = math.floor(duration_s * rate_hz * (1 + 1e-12) + 1e-6) + 1
    if not 2 <= count <= MOST_SAMPLES:
        raise Unreadable(f"comes to {count:,} samples, must be 2 to {MOST_SAMPLES:,}")
    return count


def resampled(times: Values, values: Values, rate_hz: float) -> Iterator[Values]:
    """Values at an even rate along the monotone curve through them, part after part."""
    from scipy.interpolate import PchipInterpolator  # half a second to load, and few ask

    count = count_at(times, rate_hz)
    for i, j in _stretches(count):
        wanted = np.minimum(times[0] + np.arange(i, j) / rate_hz, times[-1])
        first = max(int(np.searchsorted(times, wanted[0])) - _KNOTS_BESIDE, 0)
        last = int(np.searchsorted(times, wanted[-1])) + _KNOTS_BESIDE
        yield PchipInterpolator(times[first:last], values[first:last])(wanted)


def _stretches(count: int) -> Iterator[tuple[int, int]]:
    for i in range(0, count, CHUNK):
        yield i, min(i + CHUNK, count)


def _tidy(rate_hz: float) -> float:
    """A whole number of hertz where the times, as they were rounded, may well mean one."""
    whole = round(rate_hz)
    return float(whole) if whole and abs(rate_hz - whole) <= 1e-4 * whole else rate_hz


def _refuse_backwards(times: Values, line_of: LineOf) -> None:
    for i, j in _stretches(len(times)):
        steps = np.diff(times[i : j + 1])
        if not (steps > 0).all():
            k = i + int(np.argmin(steps > 0)) + 1
            before, now = say(float(times[k - 1]), "s"), say(float(times[k]), "s")
            raise Unreadable(f"{now} does not come after {before}", line_of(k))


def _refuse_gaps(times: Values, usual_s: float, line_of: LineOf) -> None:
    for i, j in _stretches(len(times)):
        steps = np.diff(times[i : j + 1])
        if len(steps) and steps.max() > LONGEST_GAP * usual_s:
            k = i + int(np.argmax(steps))
            gap, usual = say(float(steps.max()), "s"), say(usual_s, "s")
            message = f"a gap of {gap} follows, where samples are {usual} apart"
            raise Unreadable(message, line_of(k))
