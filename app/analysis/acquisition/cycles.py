"""Acquisitions by cycle: peaks and valleys of every one, the waveform of a few."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.acquisition.table import Column, Rows, channel_columns, joined
from app.analysis.cycles import CycleReader
from app.analysis.evidence import Stretch
from app.analysis.walk import NEEDED, Columns, Part, Walk

_EXTREMES = (  # name, unit, name of its time; fields of CYCLE
    ("peak_force_n", "N", "peak_force_time_s", "peak_n", "peak_tick"),
    ("valley_force_n", "N", "valley_force_time_s", "valley_n", "valley_tick"),
    (
        *("peak_displacement_m", "m", "peak_displacement_time_s"),
        *("displacement_peak_m", "displacement_peak_tick"),
    ),
    (
        *("valley_displacement_m", "m", "valley_displacement_time_s"),
        *("displacement_valley_m", "displacement_valley_tick"),
    ),
)
CHOSEN = tuple(digit * 10**power for power in range(10) for digit in (1, 2, 5))


class PeakValley:
    """Every counted cycle: its highest and lowest force and displacement, and when.

    `whole` is 0 for a cycle that a hold or a gap interrupted.
    """

    def __init__(self, program: Iterable[Stretch], period_s: float, first_tick: int) -> None:
        self._walk = Walk(program, period_s, first_tick)
        self._reader = CycleReader()
        self._period_s, self._first_tick = period_s, first_tick
        self.needs = NEEDED
        self.columns = (
            Column("block", "1", "i4"),
            Column("cycle", "1", "i8"),
            Column("whole", "1", "i1"),
            *(
                column
                for name, unit, at, _, _ in _EXTREMES
                for column in (Column(name, unit, "f8"), Column(at, "s", "f8"))
            ),
        )

    def take(self, chunk: Columns) -> Rows:
        """The cycles that are over."""
        found = [self._reader.take(part) for part in self._walk.take(chunk)]
        return joined([self._shown(rows) for rows in found], self.columns)

    def close(self) -> Rows:
        """The cycle that the run ended with, unless that was cut short."""
        return joined([self._shown(self._reader.close())], self.columns)

    def _shown(self, rows: npt.NDArray[Any]) -> Rows:
        shown: Rows = {name: rows[name] for name in ("block", "cycle", "whole")}
        for name, _, at, value, tick in _EXTREMES:
            shown[name] = rows[value]
            shown[at] = (rows[tick] - self._first_tick) * self._period_s
        return shown


class LogarithmicCycles:
    """Every tick of cycles 1, 2, 5, 10, 20, 50 and so on of each block.

    `extreme` is 1 at the highest force of a cycle and -1 at its lowest.
    """

    def __init__(
        self, program: Iterable[Stretch], channels: Sequence[str], period_s: float, first_tick: int
    ) -> None:
        self._walk = Walk(program, period_s, first_tick, also=channels)
        self._channels = tuple(channels)
        self._period_s, self._first_tick = period_s, first_tick
        self._pending: list[Rows] = []  # of one cycle
        self.needs = tuple(dict.fromkeys([*NEEDED, *channels]))
        self.columns = (
            Column("block", "1", "i4"),
            Column("cycle", "1", "i8"),
            Column("time_s", "s", "f8"),
            Column("extreme", "1", "i1"),
            *channel_columns(channels),
        )

    def take(self, chunk: Columns) -> Rows:
        """The chosen cycles that are over."""
        done: list[Rows] = []
        for part in self._walk.take(chunk):
            if part.begins:
                done += self._over()
            if part.stretch.counts:
                done += self._chosen(part)
        return joined(done, self.columns)

    def close(self) -> Rows:
        """The cycle that the run ended in, where it was chosen."""
        return joined(self._over(), self.columns)

    def _chosen(self, part: Part) -> list[Rows]:
        numbers = part.columns["cycle"].astype(np.int64) + 1
        firsts = np.flatnonzero(np.diff(numbers, prepend=numbers[0] - 1))
        lasts = np.append(firsts[1:], len(numbers))
        wanted = np.isin(numbers[firsts], CHOSEN)
        done: list[Rows] = []
        for first, last in zip(firsts[wanted], lasts[wanted], strict=True):
            done += self._over_but(int(numbers[first]))
            self._pending.append(self._rows(part, int(first), int(last)))
        return [*done, *self._over_but(int(numbers[-1]))]

    def _rows(self, part: Part, first: int, last: int) -> Rows:
        inner = {name: values[first:last] for name, values in part.columns.items()}
        rows: Rows = {name: inner[name] for name in self._channels}
        rows["force"] = inner["force_n"]
        rows["time_s"] = (inner["tick"] - self._first_tick) * self._period_s
        rows["cycle"] = inner["cycle"].astype(np.int64) + 1
        rows["block"] = np.full(last - first, part.stretch.block)
        return rows

    def _over_but(self, number: int) -> list[Rows]:
        """The pending cycle, unless it is this one, which goes on."""
        goes_on = bool(self._pending) and self._pending[0]["cycle"][0] == number
        return [] if goes_on else self._over()

    def _over(self) -> list[Rows]:
        """The cycle that has come to its end, its extremes marked."""
        pieces, self._pending = self._pending, []
        if not pieces:
            return []
        cycle = {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}
        extreme = np.zeros(len(cycle["time_s"]), np.int8)
        extreme[np.argmin(cycle["force"])], extreme[np.argmax(cycle["force"])] = -1, 1
        return [cycle | {"extreme": extreme}]
