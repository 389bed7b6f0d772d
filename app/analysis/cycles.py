"""Cycle after cycle: highest and lowest force and displacement, and when."""

from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.walk import Part
from rtcore.compiled import entry

CYCLE = np.dtype(
    [
        ("block", "i4"),
        ("cycle", "i8"),  # its number in the block, from 1
        ("whole", "?"),  # False where a hold or a gap interrupted it
        ("peak_n", "f8"),
        ("peak_tick", "i8"),
        ("valley_n", "f8"),
        ("valley_tick", "i8"),
        ("displacement_peak_m", "f8"),
        ("displacement_peak_tick", "i8"),
        ("displacement_valley_m", "f8"),
        ("displacement_valley_tick", "i8"),
    ],
    align=True,
)
_AT = np.dtype(
    [("row", CYCLE), ("last_tick", "i8"), ("last_position", "i8"), ("begun", "?")], align=True
)


class CycleReader:
    """Reads the counted cycles of a run, part after part."""

    def __init__(self) -> None:
        self._at = np.zeros(1, _AT)
        self._end = 0  # tick of the program after the stretch
        self._left = 0  # cycles that the stretch has still to give

    def take(self, part: Part) -> npt.NDArray[Any]:
        """(n,) CYCLE that are over with the next part of the run, of whatever kind."""
        done = self.close() if part.begins else np.zeros(0, CYCLE)
        stretch = part.stretch
        if not stretch.counts:
            return done
        if part.begins:
            self._end, self._left = stretch.last, stretch.cycles
            self._at["row"]["whole"] = part.positions[0] == stretch.first
            self._at["row"]["block"] = stretch.block
        columns = part.columns
        room = 1 + int(np.count_nonzero(np.diff(columns["cycle"])))
        rows = np.zeros(room + 1, CYCLE)
        count = _read(
            self._at,
            rows,
            columns["tick"],
            columns["cycle"],
            columns["force_n"],
            columns["displacement_m"],
        )
        self._at["last_position"] = part.positions[-1]
        self._left -= count
        return np.concatenate([done, rows[:count]])

    def close(self) -> npt.NDArray[Any]:
        """(0 or 1,) CYCLE: the one that the stretch ended with, unless that was cut short."""
        at = self._at[0]
        if not at["begun"]:
            return np.zeros(0, CYCLE)
        at["begun"] = False
        beyond = self._left < 1  # the stretch lasts no whole number of cycles
        cut = at["last_position"] + 1 < self._end
        return np.zeros(0, CYCLE) if beyond or cut else np.array([at["row"]], CYCLE)


@entry
def _read(
    state: npt.NDArray[Any],
    rows: npt.NDArray[Any],
    ticks: npt.NDArray[np.int64],
    cycles: npt.NDArray[np.int32],
    force_n: npt.NDArray[np.float32],
    displacement_m: npt.NDArray[np.float32],
) -> int:
    """Fill in rows; how many."""
    at = state[0]
    now = at.row
    count = 0
    for i in range(len(ticks)):
        number = cycles[i] + 1
        fresh = not at.begun or number != now.cycle
        if at.begun and ticks[i] != at.last_tick + 1:
            now.whole = False
        if fresh and at.begun:
            rows[count] = now
            count += 1
            now.whole = ticks[i] == at.last_tick + 1
        if fresh:
            now.cycle = number
            at.begun = True
        force, displacement = np.float64(force_n[i]), np.float64(displacement_m[i])
        if fresh or not (force <= now.peak_n):
            now.peak_n, now.peak_tick = force, ticks[i]
        if fresh or not (force >= now.valley_n):
            now.valley_n, now.valley_tick = force, ticks[i]
        if fresh or not (displacement <= now.displacement_peak_m):
            now.displacement_peak_m, now.displacement_peak_tick = displacement, ticks[i]
        if fresh or not (displacement >= now.displacement_valley_m):
            now.displacement_valley_m, now.displacement_valley_tick = displacement, ticks[i]
        at.last_tick = ticks[i]
    return count
