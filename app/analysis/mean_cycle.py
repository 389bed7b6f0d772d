"""The mean cycle of a run: its channels over the phase of the setpoint, wherever that began.

So runs compare that began, were held or turned at other times, or at another frequency.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline

from app.analysis.evidence import Sine, Stretch
from app.analysis.walk import Columns, Part, Walk

BINS = 720  # of a cycle, in which samples are gathered
MOST_FITTED = 20_000  # ticks that the setpoint's phase is read from
LEAST_BINS = 5  # a cycle with fewer samples is none

Floats = npt.NDArray[np.float64]


class MeanCycle:
    """Gathers the counted cycles of one block's first sine; part after part of a run."""

    def __init__(
        self,
        stretches: Iterable[Stretch],
        channels: Sequence[str],
        period_s: float,
        first_tick: int,
        block: int | None = None,
    ) -> None:
        """`block` is None for the first that has a sine."""
        self._walk = Walk(stretches, period_s, first_tick, also=channels)
        self._channels = tuple(channels)
        self._period_s = period_s
        self.block = block
        self.sine: Sine | None = None
        self.cycles = 0.0
        self._all = _Gathered()
        self._of = {name: _Gathered() for name in self._channels}
        self._zero: float | None = (
            None  # of the present stretch: tick at which its setpoint is at its top
        )

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        for part in self._walk.take(chunk):
            if self._wanted(part):
                self._gather(part)

    def at(self, phases: Floats) -> dict[str, Floats] | None:
        """(n,) each channel at phases, in cycles from the setpoint's top; None where there is no cycle.

        A channel is NaN at a phase at which it never was a number.
        """
        there = np.flatnonzero(self._all.counts > 0)
        if len(there) < LEAST_BINS:
            return None
        starts = _apart(self._all.sums[there] / self._all.counts[there])
        if len(starts) < LEAST_BINS:
            return None

        def gathered(values: Floats) -> Floats:
            return np.add.reduceat(values[there], starts)

        x = gathered(self._all.sums) / gathered(self._all.counts)
        found = {}
        for name, channel in self._of.items():
            counts = gathered(channel.counts)
            y = np.divide(gathered(channel.sums), counts, np.full_like(x, np.nan), where=counts > 0)
            found[name] = _around(x, y, phases)
        return found

    def _wanted(self, part: Part) -> bool:
        stretch = part.stretch
        if part.begins:
            self._zero = None
        if stretch.sine is None or self.block not in (None, stretch.block):
            return False
        if self.sine is None:
            self.sine, self.block = stretch.sine, stretch.block
        return stretch.sine == self.sine

    def _gather(self, part: Part) -> None:
        assert self.sine is not None
        per_tick = self.sine.frequency_hz * self._period_s
        there = part.in_phase
        ticks = part.columns["tick"][there]
        if self._zero is None:
            self._zero = _top(ticks, part.columns["force_command_n"][there], per_tick)
        if self._zero is None:
            return
        phases = ((ticks - self._zero) * per_tick) % 1.0
        phases -= phases > 1 - 0.5 / BINS  # the last half bin is the first half of the first
        bins = np.minimum(np.floor(phases * BINS + 0.5).astype(np.int64), BINS - 1)
        self._all.take(bins, phases)
        for name, channel in self._of.items():
            channel.take(bins, part.columns[name][there])
        self.cycles += len(ticks) * per_tick


class _Gathered:
    """How many numbers there were in each bin, and their sums."""

    def __init__(self) -> None:
        self.counts = np.zeros(BINS)
        self.sums = np.zeros(BINS)

    def take(self, bins: npt.NDArray[np.int64], values: npt.NDArray[Any]) -> None:
        """(n,) values and the bins that they fall into; what is no number is left out."""
        there = np.isfinite(values)
        self.counts += np.bincount(bins[there], minlength=BINS)
        self.sums += np.bincount(bins[there], values[there], minlength=BINS)


def _top(ticks: npt.NDArray[Any], command: npt.NDArray[Any], per_tick: float) -> float | None:
    """A tick, perhaps between two, at which the setpoint is at its top; None of less than a cycle."""
    there = np.flatnonzero(np.isfinite(command))
    if (len(there) + 0.5) * per_tick < 1:
        return None
    there = there[:MOST_FITTED]
    ticks, command = ticks[there], command[there]
    angles = 2 * np.pi * ((ticks - ticks[0]) * per_tick)
    parts = np.column_stack([np.cos(angles), np.sin(angles), np.ones(len(angles))])
    cosine, sine, _ = np.linalg.lstsq(parts, np.asarray(command, np.float64), rcond=None)[0]
    return float(ticks[0] + np.arctan2(sine, cosine) / (2 * np.pi * per_tick))


def _apart(x: Floats) -> npt.NDArray[np.int64]:
    """Where, in ascending phases, another one begins: those less than half a bin apart are one.

    Samples at the same phase of each cycle lie in two bins where rounding puts them on either side.
    """
    return np.flatnonzero(np.diff(x, prepend=-1.0) > 0.5 / BINS)


def _around(x: Floats, y: Floats, phases: Floats) -> Floats:
    """A smooth periodic curve through (m,) values at ascending phases below 1, NaN where the nearest is."""
    there = np.isfinite(y)
    if np.count_nonzero(there) < LEAST_BINS:
        return np.full(len(phases), np.nan)
    nearest = np.abs((phases[:, None] - x + 0.5) % 1.0 - 0.5).argmin(axis=1)
    x, y = x[there], y[there]
    curve = CubicSpline(np.append(x, x[0] + 1), np.append(y, y[0]), bc_type="periodic")
    return np.where(there[nearest], curve(x[0] + (phases - x[0]) % 1.0), np.nan)
