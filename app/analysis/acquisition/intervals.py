"""Acquisitions by time: a row for each interval of the run, whatever its program does."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from app.analysis.acquisition.table import Column, Rows, channel_columns, joined
from app.analysis.walk import Columns

Whole = npt.NDArray[np.int64]


class _Intervals:
    """Least, greatest and last value of channels in intervals of `every_ticks`, whole or not.

    Interval k ends at the tick nearest to k·`every_ticks` after the run's first, that tick
    included; it begins after the one before. One without any tick has no row.
    """

    def __init__(self, channels: Sequence[str], every_ticks: float, first_tick: int) -> None:
        self.channels = tuple(channels)
        self._every_ticks = every_ticks
        self._first_tick = first_tick
        self._pending: Rows | None = None

    def take(self, chunk: Columns) -> list[Rows]:
        """(n,) intervals that are over: `interval`, `end`, `last`, and `low_`, `high_`, `at_`."""
        offsets = np.asarray(chunk["tick"], np.int64) - self._first_tick
        if len(offsets) == 0:
            return []
        numbers = self._numbers(offsets)
        starts = np.flatnonzero(np.diff(numbers, prepend=numbers[0] - 1))
        lasts = np.append(starts[1:], len(offsets)) - 1
        rows: Rows = {"interval": numbers[starts], "last": offsets[lasts]}
        rows["block"], rows["cycle"] = chunk["block"][lasts], chunk["cycle"][lasts]
        for name in self.channels:
            values = np.asarray(chunk[name])
            rows["low_" + name] = np.fmin.reduceat(values, starts)
            rows["high_" + name] = np.fmax.reduceat(values, starts)
            rows["at_" + name] = values[lasts]
        return self._completed(rows)

    def close(self) -> list[Rows]:
        """The interval that the run ended in."""
        pending, self._pending = self._pending, None
        return [] if pending is None else [pending]

    def end_of(self, intervals: Whole) -> Whole:
        """The last tick of each, counted from the run's first."""
        return np.asarray(np.floor(intervals * self._every_ticks + 0.5), np.int64)

    def _numbers(self, offsets: Whole) -> Whole:
        first = int(offsets[0] / self._every_ticks) - 1
        count = int((offsets[-1] - offsets[0]) / self._every_ticks) + 4
        ends = self.end_of(np.arange(first, first + count))
        return first + np.searchsorted(ends, offsets)

    def _completed(self, rows: Rows) -> list[Rows]:
        """All but the last interval, which may go on; joined to what began in the chunk before."""
        done: list[Rows] = []
        if self._pending is not None:
            if self._pending["interval"][0] == rows["interval"][0]:
                self._join(rows, self._pending)
            else:
                done.append(self._pending)
        done.append({name: values[:-1] for name, values in rows.items()})
        self._pending = {name: values[-1:].copy() for name, values in rows.items()}
        return done

    def _join(self, rows: Rows, begun: Rows) -> None:
        for name in self.channels:
            low, high = rows["low_" + name], rows["high_" + name]
            low[0] = np.fmin(low[0], begun["low_" + name][0])
            high[0] = np.fmax(high[0], begun["high_" + name][0])


class Timed:
    """At a rate: each channel at the instant, and its least and greatest value since the last one.

    So nothing that happens between two instants goes unseen. Where the tick of an instant was not
    recorded, there is no value at it.
    """

    def __init__(
        self, channels: Sequence[str], rate_hz: float, period_s: float, first_tick: int
    ) -> None:
        self._intervals = _Intervals(channels, 1 / (rate_hz * period_s), first_tick)
        self._period_s = period_s
        self.needs = ("tick", "block", "cycle", *channels)
        by_channel = zip(
            channel_columns(channels),
            channel_columns(channels, "min_"),
            channel_columns(channels, "max_"),
            strict=True,
        )
        self.columns = (
            Column("time_s", "s", "f8"),
            Column("block", "1", "i4"),
            Column("cycle", "1", "i8"),
            *(column for three in by_channel for column in three),
        )

    def take(self, chunk: Columns) -> Rows:
        """The instants that are past."""
        return joined([self._shown(rows) for rows in self._intervals.take(chunk)], self.columns)

    def close(self) -> Rows:
        """The last instant, where the run ended at one; what is after it has none."""
        last = [
            self._shown(rows)
            for rows in self._intervals.close()
            if rows["last"][0] == self._intervals.end_of(rows["interval"])[0]
        ]
        return joined(last, self.columns)

    def _shown(self, rows: Rows) -> Rows:
        ends = self._intervals.end_of(rows["interval"])
        there = rows["last"] == ends
        shown: Rows = {"time_s": ends * self._period_s}
        shown["block"], shown["cycle"] = rows["block"], rows["cycle"]
        for name in self._intervals.channels:
            shown[name] = np.where(there, rows["at_" + name], np.float32(np.nan))
            shown["min_" + name], shown["max_" + name] = rows["low_" + name], rows["high_" + name]
        return shown


class MaxMin:
    """The greatest and the least of each channel in every `every_s`; the last one may be shorter."""

    def __init__(
        self, channels: Sequence[str], every_s: float, period_s: float, first_tick: int
    ) -> None:
        # An interval ends with its last tick here, not at an instant: so they begin a tick before.
        self._intervals = _Intervals(channels, every_s / period_s, first_tick - 1)
        self._period_s = period_s
        self.needs = ("tick", "block", "cycle", *channels)
        by_channel = zip(
            channel_columns(channels, "min_"), channel_columns(channels, "max_"), strict=True
        )
        self.columns = (
            Column("from_s", "s", "f8"),
            Column("to_s", "s", "f8"),
            Column("block", "1", "i4"),
            Column("cycle", "1", "i8"),
            *(column for two in by_channel for column in two),
        )

    def take(self, chunk: Columns) -> Rows:
        """The intervals that are over."""
        return joined([self._shown(rows) for rows in self._intervals.take(chunk)], self.columns)

    def close(self) -> Rows:
        """The interval that the run ended in."""
        return joined([self._shown(rows) for rows in self._intervals.close()], self.columns)

    def _shown(self, rows: Rows) -> Rows:
        begins = self._intervals.end_of(rows["interval"] - 1)
        shown: Rows = {"from_s": begins * self._period_s, "to_s": rows["last"] * self._period_s}
        shown["block"], shown["cycle"] = rows["block"], rows["cycle"]
        for name in self._intervals.channels:
            shown["min_" + name], shown["max_" + name] = rows["low_" + name], rows["high_" + name]
        return shown
