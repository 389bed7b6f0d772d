"""Multisines: many sines in one period, their phases chosen so that they need little amplitude together.

Schroeder's phases first (IEEE Trans. Inf. Theory 16, 1970), then clipping as of Van der Ouderaa, Schoukens and
Renneboog (IEEE Trans. Instrum. Meas. 37, 1988): clip the signal, keep the phases of what is left.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Literal

import numpy as np
import numpy.typing as npt

from app.definitions.limits import RIG
from app.histories.history import History, from_values

Lines = Literal["all", "odd", "odd_random"]
Floats = npt.NDArray[np.float64]
_GROUP = 4  # of successive odd lines: one of them is left out
_CLIPPED = np.linspace(0.3, 0.95, 200)  # of the peak, round by round
_QUICKLY = _CLIPPED[
    ::4
]  # where there are several realisations: 3 % more crest in a quarter of the time
_ENDLESS = 1e12
_LARGEST = 1 << 15  # samples of a period whose phases are worth the rounds


@dataclass(frozen=True)
class Grid:
    """A period in ticks, and which of its multiples are excited: frequency = line / period."""

    period_ticks: int
    lines: tuple[int, ...]
    realisation: int = 0  # 0: of least crest; else of random phases, others for each number

    def frequencies_hz(self) -> tuple[float, ...]:
        """The frequency of each line."""
        return tuple(line * RIG.loop_rate_hz / self.period_ticks for line in self.lines)


def grid_of_list(frequencies_hz: Sequence[float]) -> Grid:
    """The shortest period of whole ticks into which each frequency fits whole."""
    exact = sorted({Fraction(str(f)) for f in frequencies_hz})
    denominator = math.lcm(*(f.denominator for f in exact))
    common = Fraction(math.gcd(*(int(f * denominator) for f in exact)), denominator)
    ticks = Fraction(round(RIG.loop_rate_hz)) / common
    period_s = ticks.denominator / common
    return Grid(int(ticks * ticks.denominator), tuple(int(f * period_s) for f in exact))


def grid_of_band(frequencies_hz: Sequence[float]) -> Grid:
    """The shortest period in which frequencies at equal ratios stay apart; they move onto its lines."""
    low, *_ = ordered = sorted(frequencies_hz)
    apart_hz = ordered[1] - low
    turns = min(low / apart_hz, _ENDLESS) if apart_hz > 0 else _ENDLESS  # of the lowest
    period_s = math.ceil(turns - 1e-9) / low
    period_ticks = math.ceil(period_s * RIG.loop_rate_hz - 1e-9)
    lines = {math.floor(f * period_ticks / RIG.loop_rate_hz + 0.5) for f in ordered}
    return Grid(period_ticks, tuple(sorted(lines)))


def chosen(grid: Grid, lines: Lines) -> Grid:
    """Those lines of a grid that are played: where none is odd the grid stays as it is."""
    odd = tuple(line for line in grid.lines if line % 2 == 1)
    if lines == "all" or not odd:
        return grid
    if lines == "odd_random":
        left_out = np.random.default_rng(len(odd)).integers(0, _GROUP, len(odd) // _GROUP)
        gone = {group * _GROUP + int(place) for group, place in enumerate(left_out)}
        odd = tuple(line for i, line in enumerate(odd) if i not in gone)
    return replace(grid, lines=odd)


@lru_cache(maxsize=8)  # of up to 3 MB
def period_of(grid: Grid) -> History:
    """One period at the loop's rate, its first sample again at its end, its greatest value 1."""
    return _played(grid, np.exp(1j * _phases(grid)))


@lru_cache(maxsize=32)  # of up to 3 MB: all realisations of a motion
def moving_period_of(grid: Grid, corner_hz: float | None = None) -> History:
    """The same for a unit under test, which is limited in its velocity: that is what has little crest.

    Above the corner the lines fall with their frequency. The phases begin at random, others for each realisation.
    """
    hz = np.array(grid.frequencies_hz())
    sizes = np.ones(len(hz)) if corner_hz is None else np.minimum(1.0, corner_hz / hz)
    phases = _least_crest(list(grid.lines), sizes * hz, _drawn(grid), _QUICKLY)
    return _played(grid, sizes * np.exp(1j * phases) / 1j)


def _played(grid: Grid, amplitudes: npt.NDArray[np.complex128]) -> History:
    """A period of these (lines,), its greatest value 1."""
    spectrum = np.zeros(grid.period_ticks // 2 + 1, np.complex128)
    spectrum[list(grid.lines)] = amplitudes
    wave = np.fft.irfft(spectrum, grid.period_ticks)
    wave /= np.abs(wave).max()
    return from_values(np.append(wave, wave[0]), RIG.loop_rate_hz)


def _phases(grid: Grid) -> Floats:
    """(lines,) rad, of a low crest: 1.5 for lines side by side, 2.2 for lines at equal ratios.

    Of a further realisation they are random, evenly from 0 to 2π: what the best linear approximation asks for.
    """
    if grid.realisation:
        return _drawn(grid)
    lines = list(grid.lines)
    # Each line has its turn in the period: the delay grows with the power that lies below.
    delay = (np.arange(len(lines)) + 0.5) / len(lines)
    schroeder = -2 * np.pi * np.cumsum(np.diff(lines, prepend=0) * delay)
    return _least_crest(lines, np.ones(len(lines)), schroeder)


def _drawn(grid: Grid) -> Floats:
    """(lines,) rad at random, others for each realisation."""
    drawn = np.random.default_rng([grid.realisation, len(grid.lines)])
    return drawn.uniform(0, 2 * np.pi, len(grid.lines))


def _least_crest(
    lines: list[int], sizes: Floats, phases: Floats, rounds: Floats = _CLIPPED
) -> Floats:
    """(lines,) rad: from these phases on to those of the least crest that clipping finds."""
    best = phases
    size, least = 1 << (16 * max(lines) - 1).bit_length(), math.inf
    for clipped in rounds if size <= _LARGEST else ():
        spectrum = np.zeros(size // 2 + 1, np.complex128)
        spectrum[lines] = sizes * np.exp(1j * phases)
        wave = np.fft.irfft(spectrum, size)
        peak = float(np.abs(wave).max())
        if peak < least:
            best, least = phases, peak
        phases = np.angle(np.fft.rfft(np.clip(wave, -clipped * peak, clipped * peak))[lines])
    return np.asarray(best)
