"""Least and greatest value of every channel over stretches of ticks: what an overview is made of.

Bins begin at multiples of their width in absolute ticks. A bin without any tick has no row, so a gap
costs nothing; NaN stands where every value of a bin is NaN, as in `numpy.fmin`.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.channels import CHANNELS, TELEMETRY

Columns = dict[str, npt.NDArray[Any]]
Rows = npt.NDArray[Any]

WIDTHS = (256, 4096, 65_536)  # ticks a bin, finest first; each a multiple of the one before
RATIOS = tuple(wide // narrow for narrow, wide in pairwise(WIDTHS))
CHANNEL_NAMES = tuple(c.name for c in CHANNELS)
_VALUES = np.dtype([(c.name, c.dtype) for c in CHANNELS])
ROW = np.dtype([("bin", "i8"), ("ticks", "i8"), ("low", _VALUES), ("high", _VALUES)])


def fold(columns: Columns, width: int) -> Rows:
    """(n,) ROW of ascending `tick` and every other channel, a row for each bin with ticks in it."""
    bins = columns["tick"] // width
    starts = starts_of(bins)
    rows = np.empty(len(starts), ROW)
    if len(starts):
        rows["bin"] = bins[starts]
        rows["ticks"] = np.diff(starts, append=len(bins))
        for name in CHANNEL_NAMES:
            rows["low"][name] = np.fmin.reduceat(columns[name], starts)
            rows["high"][name] = np.fmax.reduceat(columns[name], starts)
    return rows


def merged(rows: Rows, ratio: int) -> Rows:
    """Rows of bins `ratio` times as wide."""
    bins = rows["bin"] // ratio
    starts = starts_of(bins)
    wider = np.empty(len(starts), ROW)
    if len(starts):
        wider["bin"] = bins[starts]
        wider["ticks"] = np.add.reduceat(rows["ticks"], starts)
        for name in CHANNEL_NAMES:
            wider["low"][name] = np.fmin.reduceat(rows["low"][name], starts)
            wider["high"][name] = np.fmax.reduceat(rows["high"][name], starts)
    return wider


def starts_of(bins: npt.NDArray[Any]) -> npt.NDArray[np.int64]:
    """Where in ascending numbers another one begins."""
    return np.flatnonzero(np.diff(bins, prepend=bins[:1] - 1))


def columns_of(records: npt.NDArray[Any]) -> Columns:
    """(n,) TELEMETRY by columns."""
    return {c.name: np.ascontiguousarray(records[c.name]) for c in CHANNELS}


class Pyramid:
    """Gathers ticks into bins of every width. Keeps only what is of bins that are not complete yet.

    `waiting` are the rows, for each width but the widest, that have not gone into wider ones yet.
    """

    def __init__(self, waiting: Sequence[Rows] = ()) -> None:
        self._columns = columns_of(np.empty(0, TELEMETRY))
        self._waiting = list(waiting) or [np.empty(0, ROW) for _ in WIDTHS[1:]]

    def add(self, columns: Columns) -> list[Rows]:
        """With these ticks, every channel, after it: the rows now complete, for each width."""
        if len(self._columns["tick"]):
            columns = {n: np.concatenate([self._columns[n], columns[n]]) for n in columns}
        complete = _last_start(columns["tick"] // WIDTHS[0])
        self._columns = {name: values[complete:].copy() for name, values in columns.items()}
        rows = fold({name: values[:complete] for name, values in columns.items()}, WIDTHS[0])
        return self._risen(rows, last=False)

    def finish(self) -> list[Rows]:
        """The rows of the bins that were not complete, for each width: nothing comes after."""
        return self._risen(fold(self._columns, WIDTHS[0]), last=True)

    def _risen(self, rows: Rows, *, last: bool) -> list[Rows]:
        found = [rows]
        for i, ratio in enumerate(RATIOS):
            waiting = np.concatenate([self._waiting[i], found[i]])
            complete = len(waiting) if last else _last_start(waiting["bin"] // ratio)
            found.append(merged(waiting[:complete], ratio))
            self._waiting[i] = waiting[complete:]
        return found


def _last_start(bins: npt.NDArray[Any]) -> int:
    """Where the last of ascending numbers begins: up to there, bins are complete."""
    return int(np.searchsorted(bins, bins[-1])) if len(bins) else 0
