"""What the phasors of a sine amount to: transfers between channels, and how sure they are.

The noise of an estimate over N cycles is that of the signal at the sine's frequency, in a band as narrow
as the estimate's own. It is read from the lines beside the sine, f ± k/T: there the residual of
output − G·input is noise alone, whatever its colour, and because the lines lie on both sides a slope of
its spectrum cancels. (The spread of single cycles sees a band N times as wide, the residual the whole
spectrum: docs/decisions/0023.)
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from app.analysis.phasors import Complex, Phasors, normal_matrix, solve
from app.analysis.response.curve import (
    CONFIDENCE,
    half_width,
    magnitude_interval,
    phase_interval_deg,
)
from app.analysis.response.point import Interval
from app.analysis.response.settling import Drift, drift_of, is_unlikely, power_of
from rtcore.compiled import Array

MOST_LINES = 3  # on each side: 12 degrees of freedom; more would look further than noise is smooth
HALF_A_TICK = 0.5  # a whole cycle may end between ticks
LEAST_SHARE = 1e-9  # of the mean: less is what rounding leaves of a channel that stands still


@dataclass(frozen=True)
class Estimate:
    """Output over input at one frequency; the variance is that of `gain` as a complex number."""

    gain: complex
    variance: float
    lines: int  # that the variance is from; 0: it is not known
    cycles: float
    steady: bool

    @property
    def gain_95(self) -> Interval:
        """Of the magnitude."""
        return Interval(*map(float, magnitude_interval(np.array(self.gain), self._half_width)))

    @property
    def phase_deg(self) -> float:
        """Negative where the output lags."""
        return math.degrees(math.atan2(self.gain.imag, self.gain.real))

    @property
    def phase_95_deg(self) -> Interval:
        """Of the phase; a whole turn where nothing is known of it."""
        return Interval(*map(float, phase_interval_deg(np.array(self.gain), self._half_width)))

    @property
    def coherence(self) -> float | None:
        """Share of the output that the input explains, 0…1, in single cycles; None where no noise is known."""
        if self.lines == 0:
            return None
        explained = abs(self.gain) ** 2
        noise = self.variance * self.cycles
        return float(explained / (explained + noise)) if explained > 0 else 0.0

    @property
    def _half_width(self) -> Array:
        return half_width(np.array(self.variance), np.array(self.lines))


@dataclass(frozen=True)
class Fit:
    """Channels fitted with a sine and its harmonics, over one stretch or several; they add.

    `sums` (channels, K+1) and `ones` (2K+1,) are those of `Phasors`; `noise` (channels, channels) is the
    covariance of the first of the sums, as the mean of so many `lines`.
    """

    channels: tuple[str, ...]
    sums: Complex
    ones: Complex
    noise: Complex
    lines: int
    cycles_per_tick: float
    drift: Drift

    @property
    def cycles(self) -> float:
        """How many it is over."""
        return float(self.ones[0].real) * self.cycles_per_tick

    @property
    def whole_cycles(self) -> int:
        """The same, where one that ends between two ticks is whole."""
        return math.floor(self.cycles + HALF_A_TICK * self.cycles_per_tick)

    @cached_property
    def parts(self) -> Complex:
        """(channels, 2K+1) of y = Σ c_k e^(jkφ), k from −K to K."""
        return np.array([solve(sums, self.ones) for sums in self.sums])

    def amplitude(self, channel: str, harmonic: int = 1) -> complex:
        """Of e^(jkφ), as the amplitude of a sine; the mean where `harmonic` is 0."""
        part = self.parts[self.channels.index(channel), self._middle + harmonic]
        return complex(part.real if harmonic == 0 else 2 * part)

    def distortion_percent(self, channel: str) -> float | None:
        """The harmonics of a channel in % of its fundamental; None where neither can be seen."""
        at = self.channels.index(channel)
        first, higher = self.parts[at, self._middle + 1], self.parts[at, self._middle + 2 :]
        if len(higher) == 0 or not abs(first) > 0:
            return None
        return float(100 * np.linalg.norm(higher) / abs(first))

    def estimate(self, input: str, output: str) -> Estimate | None:
        """Output over input; None where the input does not move at this frequency."""
        return self.ratio(self._just(input), self._just(output))

    def ratio(self, input: Complex, output: Complex) -> Estimate | None:
        """As `estimate`, of sums of channels with (channels,) weights each."""
        first = self.parts[:, self._middle + 1]
        below, above = complex(input @ first), complex(output @ first)
        if not self._moves(input):
            return None
        gain = above / below
        left = output - gain * input
        variance = power_of(left, self.noise) * self._share / abs(below) ** 2
        steady = self.drift.is_steady(left, complex(output @ self.sums[:, 1]))
        return Estimate(gain, variance, self.lines, self.cycles, steady)

    def added(self, other: "Fit", reference: str) -> "Fit":
        """Both, each turned to the phase of the same channel."""
        mine, its = self._turned(reference), other._turned(reference)
        return Fit(
            self.channels,
            mine.sums + its.sums,
            mine.ones + its.ones,
            self.noise + other.noise,
            min(self.lines, other.lines) and self.lines + other.lines,
            self.cycles_per_tick,
            other.drift,
        )

    @property
    def _middle(self) -> int:
        return int(self.sums.shape[1]) - 1

    @cached_property
    def _share(self) -> float:
        """Variance of a part, where the sum that it is from has a variance of 1."""
        inverse = np.linalg.pinv(normal_matrix(self.ones), rcond=1e-10, hermitian=True)
        return float(inverse[self._middle + 1, self._middle + 1].real / self.ones[0].real)

    def _just(self, channel: str) -> Complex:
        weights = np.zeros(len(self.channels), np.complex128)
        weights[self.channels.index(channel)] = 1.0
        return weights

    def _moves(self, weights: Complex) -> bool:
        """Whether a sum of channels has the sine in it, beyond what noise and rounding put there."""
        mean, first = np.abs(weights @ self.parts[:, self._middle : self._middle + 2])
        if not first > LEAST_SHARE * mean:
            return False
        if self.lines == 0:
            return True
        power = power_of(weights, self.noise) * self._share
        return is_unlikely(float(first) ** 2, power, self.lines, 1 - CONFIDENCE)

    def _turned(self, reference: str) -> "Fit":
        angle = float(np.angle(self.amplitude(reference)))
        turn = np.exp(-1j * angle * np.arange(len(self.ones)))
        sums, ones = self.sums * turn[: self.sums.shape[1]], self.ones * turn
        return replace(self, sums=sums, ones=ones)


def fit_of(phasors: Phasors) -> Fit:
    """The fit of a stretch; of at least one tick."""
    sums, ones = phasors.sums.sum(axis=1), phasors.ones.sum(axis=0)
    left = _residual(phasors, np.array([solve(one, ones) for one in sums]))
    ticks = phasors.ones[:, 0].real
    cycles = (ticks.sum() + HALF_A_TICK) * phasors.cycles_per_tick
    lines = min(MOST_LINES, math.floor(cycles / 2))
    share = phasors.cell_ticks / phasors.span_ticks
    beside = _lines_beside(lines, share, len(ticks))
    found = left @ beside
    noise = found @ found.conj().T / max(1, 2 * lines)
    drift = drift_of(left, ticks, share, beside)
    return Fit(phasors.channels, sums, ones, noise, 2 * lines, phasors.cycles_per_tick, drift)


def _residual(phasors: Phasors, parts: Complex) -> Complex:
    """(channels, cells) Σ (y − fit) e^(−jφ)."""
    highest = phasors.harmonics
    away = 1 - np.arange(-highest, highest + 1)
    ones = phasors.ones[:, np.abs(away)]
    ones = np.where(away >= 0, ones, ones.conj())
    return np.asarray(phasors.sums[:, :, 1] - parts @ ones.T)


def _lines_beside(lines: int, share: float, cells: int) -> Complex:
    """(cells, 2 lines) to read the lines f ± k/T from cells, each that share of T long."""
    k = np.concatenate([np.arange(-lines, 0), np.arange(1, lines + 1)])
    turned = np.outer((np.arange(cells) + 0.5) * share, k)
    return np.asarray(np.exp(-2j * np.pi * turned) / np.sinc(k * share))
