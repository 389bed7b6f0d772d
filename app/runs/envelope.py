"""Minimum and maximum over equal stretches of ticks: what a chart needs, never a stride.

A long window is put together from the bins of a run's overview, and at its two ends from the ticks
themselves, so that nothing outside it counts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.recording.bins import WIDTHS, Columns, Rows, starts_of
from app.recording.samples import Levels, Samples

Floats = npt.NDArray[np.float64]
_FINER = 4  # bins of an overview in a stretch, at least: else rounding its width costs many points


@dataclass(frozen=True)
class Envelope:
    """(n_bins,) first tick of each bin, and (n_bins,) least and greatest value a channel.

    A bin without any tick is left out. NaN stands where every value of the bin is NaN.
    """

    ticks: npt.NDArray[np.int64]
    low: dict[str, Floats]
    high: dict[str, Floats]
    bin_ticks: int


@dataclass(frozen=True)
class _Piece:
    """(n,) first ticks, and the least and greatest values from there on, of some channels."""

    ticks: npt.NDArray[np.int64]
    low: Columns | Rows
    high: Columns | Rows


def envelope(
    samples: Samples, names: Sequence[str], first_tick: int, last_tick: int, points: int
) -> Envelope:
    """At most `points` bins of equal width over the ticks from `first_tick` to `last_tick`, both in it.

    Bins begin at multiples of their width, so that a window that moves shows the same ones again; a
    bin that reaches out of the window tells only of what is inside.
    """
    count = last_tick - first_tick + 1
    if count <= 0:
        return _Bins(names, 0, 0, 1).envelope(first_tick)
    width = _width(count, points)
    levels = samples.levels() if width >= WIDTHS[0] else ()
    if points == 1:
        bins = _Bins(names, first_tick, 1, width)
    else:
        width, levels = _fitted(width, levels)
        origin = first_tick // width * width
        bins = _Bins(names, origin, (last_tick - origin) // width + 1, width)
    for piece in _pieces(samples, levels, names, first_tick, last_tick):
        bins.take(piece)
    return bins.envelope(first_tick)


def _width(count: int, points: int) -> int:
    """Ticks a bin: wherever its multiples lie, no more than `points` bins touch the window."""
    if count <= points:
        return 1
    return count if points == 1 else -(-count // (points - 1))


def _fitted(width: int, levels: Levels) -> tuple[int, Levels]:
    """A width that bins of the overview fill evenly, and the levels that do."""
    if not levels:
        return width, ()
    fine = [level for level in levels if level.width * _FINER <= width] or [levels[0]]
    base = fine[-1].width
    return -(-width // base) * base, tuple(fine)


class _Bins:
    """The bins that pieces are put into."""

    def __init__(self, names: Sequence[str], origin: int, count: int, width: int) -> None:
        self._origin, self._width = origin, width
        self._seen = np.zeros(count, dtype=np.bool_)
        self._low = {name: np.full(count, np.nan) for name in names}
        self._high = {name: np.full(count, np.nan) for name in names}

    def take(self, piece: _Piece) -> None:
        places = (piece.ticks - self._origin) // self._width
        starts = starts_of(places)
        if len(starts) == 0:
            return
        at = places[starts]
        self._seen[at] = True
        for name, low in self._low.items():
            low[at] = np.fmin(low[at], np.fmin.reduceat(piece.low[name], starts))
        for name, high in self._high.items():
            high[at] = np.fmax(high[at], np.fmax.reduceat(piece.high[name], starts))

    def envelope(self, first_tick: int) -> Envelope:
        ticks = self._origin + self._width * np.flatnonzero(self._seen)
        return Envelope(
            ticks=np.maximum(ticks, first_tick),
            low={name: values[self._seen] for name, values in self._low.items()},
            high={name: values[self._seen] for name, values in self._high.items()},
            bin_ticks=self._width,
        )


def _pieces(
    samples: Samples, levels: Levels, names: Sequence[str], first_tick: int, last_tick: int
) -> Iterator[_Piece]:
    """The widest bins that lie in the window, finer ones beside them, and ticks at its very ends."""
    if first_tick > last_tick:
        return
    if not levels:
        for columns in samples.chunks(names, first_tick, last_tick):
            yield _Piece(columns["tick"], columns, columns)
        return
    *finer, level = levels
    start = -(-first_tick // level.width)
    end = min(last_tick + 1, level.to_tick) // level.width
    if start >= end:
        yield from _pieces(samples, tuple(finer), names, first_tick, last_tick)
        return
    yield from _pieces(samples, tuple(finer), names, first_tick, start * level.width - 1)
    low, high = np.searchsorted(level.rows["bin"], (start, end))
    rows = level.rows[low:high]
    yield _Piece(rows["bin"] * level.width, rows["low"], rows["high"])
    yield from _pieces(samples, tuple(finer), names, end * level.width, last_tick)
