"""Correlations of channels with a sine and its harmonics: the sums of every least-squares fit of sines.

What is summed up, cell of time after cell, are Σ y e^(−jkφ) of each channel and of 1. φ runs on with the
ticks in closed form, so the sampling instants are exact, and a tick that is missing is missing in all.
Where the cells are used up, each two become one: memory does not grow.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Array, entry, inlined

Complex = npt.NDArray[np.complex128]
Ticks = npt.NDArray[np.int64]
HIGHEST_HARMONIC = 10
CELLS = 256
CELLS_A_CYCLE = 4  # at least, while they last
_RUN = 64  # ticks whose turns are kept in a table
_LANES = 8  # of the table that are summed up at once


def harmonics_below_half_rate(cycles_per_tick: float) -> int:
    """How many harmonics of a sine, itself counted, are fitted: at least 1."""
    below = math.ceil(0.5 / cycles_per_tick - 1e-9) - 1
    return max(1, min(HIGHEST_HARMONIC, below))


class Phasors:
    """Sums over one stretch of ticks.

    φ = 0 at tick `began_at`, and goes on with the ticks; cells are of program time from `first`, which
    stands still in a hold.
    """

    def __init__(
        self, channels: Sequence[str], cycles_per_tick: float, began_at: int, first: int
    ) -> None:
        self.channels = tuple(channels)
        self.cycles_per_tick = cycles_per_tick
        self._began_at, self._first = began_at, first
        self.harmonics = harmonics_below_half_rate(cycles_per_tick)
        self.cell_ticks = max(1, math.floor(1 / (CELLS_A_CYCLE * cycles_per_tick)))
        self._sums = np.zeros((len(self.channels), CELLS, self.harmonics + 1), np.complex128)
        self._ones = np.zeros((CELLS, 2 * self.harmonics + 1), np.complex128)
        self.span_ticks = 0  # of the program, so far
        self._turns = _turns(cycles_per_tick, self.harmonics)
        self._ramps = _ramps(cycles_per_tick, 2 * self.harmonics)

    @property
    def sums(self) -> Complex:
        """(channels, cells, harmonics + 1) Σ y e^(−jkφ)."""
        return self._sums[:, : self._used]

    @property
    def ones(self) -> Complex:
        """(cells, 2 harmonics + 1) Σ e^(−jkφ)."""
        return self._ones[: self._used]

    @property
    def _used(self) -> int:
        return -(-self.span_ticks // self.cell_ticks)

    def take(self, positions: Ticks, columns: Mapping[str, npt.NDArray[Any]]) -> None:
        """The next ticks, (n,) ascending and n > 0, and the channels in them, "tick" among them."""
        ticks = columns["tick"] - self._began_at
        cells = positions - self._first
        self.span_ticks = int(cells[-1]) + 1
        while self._used > CELLS:
            self._halve()
        at = self.cycles_per_tick, self.cell_ticks
        _count(self._ones, ticks, cells, self._ramps, *at)
        for sums, name in zip(self._sums, self.channels, strict=True):
            _correlate(sums, ticks, cells, columns[name], self._turns, *at)

    def _halve(self) -> None:
        """Make one cell of each two."""
        half = CELLS // 2
        for cells in (*self._sums, self._ones):
            cells[:half] = cells[0::2] + cells[1::2]
            cells[half:] = 0
        self.cell_ticks *= 2


def solve(correlations: Complex, ones: Complex) -> Complex:
    """(2K+1,) parts c of y = Σ c_k e^(jkφ), k from −K to K, from Σ y e^(−jkφ), k from 0 to K.

    `ones` are Σ e^(−jkφ), k from 0 to 2K. NaN where the correlations are no numbers.
    """
    right = np.concatenate([np.conj(correlations[:0:-1]), correlations])
    if not np.isfinite(right).all():
        return np.full(len(right), np.nan + 0j)
    return np.asarray(np.linalg.lstsq(normal_matrix(ones), right, rcond=1e-10)[0])


def normal_matrix(ones: Complex) -> Complex:
    """(2K+1, 2K+1) of the fit's normal equations, from Σ e^(−jkφ), k from 0 to 2K."""
    highest = len(ones) // 2
    k = np.arange(-highest, highest + 1)
    apart = k[:, None] - k[None, :]
    return np.asarray(np.where(apart >= 0, ones[np.abs(apart)], np.conj(ones[np.abs(apart)])))


@lru_cache(maxsize=64)
def _turns(cycles_per_tick: float, harmonics: int) -> Array:
    """(groups, _RUN, _LANES): e^(−jkφ) of the ticks of a run that begins at φ = 0, k from 0."""
    turned = np.outer(np.arange(_RUN), np.arange(harmonics + 1)) * cycles_per_tick
    phasors = np.exp(-2j * np.pi * (turned % 1.0))
    groups = -(-2 * (harmonics + 1) // _LANES)
    flat = np.zeros((_RUN, groups * _LANES))
    flat[:, 0 : 2 * (harmonics + 1) : 2] = phasors.real
    flat[:, 1 : 2 * (harmonics + 1) : 2] = phasors.imag
    return np.ascontiguousarray(flat.reshape(_RUN, groups, _LANES).transpose(1, 0, 2))


@lru_cache(maxsize=64)
def _ramps(cycles_per_tick: float, highest: int) -> Complex:
    """(_RUN + 1, highest + 1): Σ e^(−jkφ) of so many ticks from φ = 0."""
    turned = np.outer(np.arange(_RUN), np.arange(highest + 1)) * cycles_per_tick
    ramps = np.zeros((_RUN + 1, highest + 1), np.complex128)
    np.cumsum(np.exp(-2j * np.pi * (turned % 1.0)), axis=0, out=ramps[1:])
    return ramps


@inlined
def _end_of_run(ticks: Ticks, positions: Ticks, i: int, cell_ticks: int) -> int:
    """One past the ticks from `i` on that follow one another within a cell, as far as the table goes."""
    left = cell_ticks - positions[i] % cell_ticks
    end: int = min(len(ticks), i + _RUN, i + left)
    while ticks[end - 1] - ticks[i] != end - 1 - i:
        end -= 1
    return end


@entry
def _count(
    ones: Complex,
    ticks: Ticks,
    positions: Ticks,
    ramps: Complex,
    cycles_per_tick: float,
    cell_ticks: int,
) -> None:
    n, i = len(ticks), 0
    while i < n:
        end = _end_of_run(ticks, positions, i, cell_ticks)
        cell = positions[i] // cell_ticks
        turned = cycles_per_tick * ticks[i]
        angle = 2.0 * math.pi * (turned - math.floor(turned))
        step, power = complex(math.cos(angle), -math.sin(angle)), complex(1.0, 0.0)
        for k in range(ones.shape[1]):
            ones[cell, k] += power * ramps[end - i, k]
            power *= step
        i = end


@entry
def _correlate(
    sums: Complex,
    ticks: Ticks,
    positions: Ticks,
    values: npt.NDArray[np.float32],
    turns: Array,
    cycles_per_tick: float,
    cell_ticks: int,
) -> None:
    """Turns the ticks of a run by the table, then their sum as a whole."""
    within, y = np.empty(len(turns) * _LANES), np.empty(_RUN)
    n, i = len(ticks), 0
    while i < n:
        end = _end_of_run(ticks, positions, i, cell_ticks)
        cell = positions[i] // cell_ticks
        run = end - i
        for j in range(run):
            y[j] = values[i + j]
        for group in range(len(turns)):
            a0 = a1 = a2 = a3 = a4 = a5 = a6 = a7 = 0.0  # eight lanes, which no other way become so
            for j in range(run):
                a0 += y[j] * turns[group, j, 0]
                a1 += y[j] * turns[group, j, 1]
                a2 += y[j] * turns[group, j, 2]
                a3 += y[j] * turns[group, j, 3]
                a4 += y[j] * turns[group, j, 4]
                a5 += y[j] * turns[group, j, 5]
                a6 += y[j] * turns[group, j, 6]
                a7 += y[j] * turns[group, j, 7]
            lane = group * _LANES
            within[lane], within[lane + 1], within[lane + 2], within[lane + 3] = a0, a1, a2, a3
            within[lane + 4], within[lane + 5], within[lane + 6], within[lane + 7] = a4, a5, a6, a7
        turned = cycles_per_tick * ticks[i]
        angle = 2.0 * math.pi * (turned - math.floor(turned))
        step, power = complex(math.cos(angle), -math.sin(angle)), complex(1.0, 0.0)
        for k in range(sums.shape[1]):
            sums[cell, k] += power * complex(within[2 * k], within[2 * k + 1])
            power *= step
        i = end
