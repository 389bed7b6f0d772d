"""Systems whose response is known in closed form, driven by known noise: what estimators are held against."""

from collections.abc import Iterator
from itertools import combinations_with_replacement
from math import factorial
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import signal

Floats = npt.NDArray[np.float64]
Complex = npt.NDArray[np.complex128]
PERIOD_S = 250e-6
LEAD_TICKS = 8000  # in which what came before has died away


def resonance(frequency_hz: float, width_hz: float) -> tuple[list[float], list[float]]:
    """A filter that makes of white noise one with a peak of so much width at half power."""
    radius = float(np.exp(-np.pi * width_hz * PERIOD_S))
    turn = 2 * np.pi * frequency_hz * PERIOD_S
    return [1.0], [1.0, -2 * radius * float(np.cos(turn)), radius**2]


WHITE = ([1.0], [1.0])
RESONANT = resonance(78.0, 60.0)  # as wide as what a control loop makes of noise
SHARP = resonance(78.0, 10.0)


class Loop(NamedTuple):
    """A discrete control loop as polynomials in 1/z: setpoint to output, noise to output and to valve."""

    closed: tuple[Floats, Floats]
    sensitivity: tuple[Floats, Floats]
    control: tuple[Floats, Floats]  # of the valve to the error

    @staticmethod
    def typical() -> "Loop":
        """A plant of second order with two ticks of delay under PI control, much as the rig's."""
        b, a = signal.butter(2, 60.0, fs=1 / PERIOD_S)
        plant_b, plant_a = 2e5 * np.concatenate([[0.0, 0.0], b]), np.asarray(a)
        control_b = np.array([4e-6 + 8e-4 * PERIOD_S, -4e-6])
        control_a = np.array([1.0, -1.0])
        over = np.polymul(control_b, plant_b)
        under = np.polymul(control_a, plant_a)
        # In powers of 1/z the longer of the two sets how many there are.
        size = max(len(over), len(under))
        over, under = np.pad(over, (0, size - len(over))), np.pad(under, (0, size - len(under)))
        return Loop((over, over + under), (under, over + under), (control_b, control_a))

    def response(self, frequencies_hz: npt.ArrayLike) -> Complex:
        """Output to setpoint."""
        return _response(*self.closed, frequencies_hz)

    def plant(self, frequencies_hz: npt.ArrayLike) -> Complex:
        """Output to valve."""
        loop = self.response(frequencies_hz) / _response(*self.sensitivity, frequencies_hz)
        return np.asarray(loop / _response(*self.control, frequencies_hz))

    def run(
        self, setpoint: Floats, seeds: int, noise_n: float, colour: tuple[list[float], list[float]]
    ) -> Iterator[tuple[Floats, Floats]]:
        """Output and valve, (n,) each, under so many draws of noise, from a state that has settled.

        The setpoint, (LEAD_TICKS + n,), has the lead before it.
        """
        clean = signal.lfilter(*self.closed, setpoint)
        scale = noise_n / np.sqrt(_power(*colour))
        for seed in range(seeds):
            drawn = np.random.default_rng(seed).normal(0, scale, len(setpoint))
            disturbed = signal.lfilter(*self.sensitivity, signal.lfilter(*colour, drawn))
            output = clean + disturbed
            valve = signal.lfilter(*self.control, setpoint - output)
            yield output[LEAD_TICKS:], valve[LEAD_TICKS:]


def _response(b: npt.ArrayLike, a: npt.ArrayLike, frequencies_hz: npt.ArrayLike) -> Complex:
    b, a = np.asarray(b, float), np.asarray(a, float)
    at = np.atleast_1d(np.asarray(frequencies_hz, float))
    return np.asarray(signal.freqz(b, a, worN=at, fs=1 / PERIOD_S)[1])


def _power(b: list[float], a: list[float]) -> float:
    """Of white noise of 1 behind the filter."""
    pulse = np.zeros(20_000)
    pulse[0] = 1.0
    return float(np.sum(signal.lfilter(b, a, pulse) ** 2))


class Cubic(NamedTuple):
    """u + share·u³ and then a filter, under random-phase multisines: its response is a closed form.

    Pintelon and Schoukens, System Identification, section 3.4, counted out instead of integrated.
    """

    share: float
    lines: npt.NDArray[np.int64]  # excited
    amplitude: float  # of each line
    period_ticks: int
    filter: tuple[Floats, Floats]

    def best_linear(self) -> Complex:
        """(lines,) the best linear approximation: each line is met by every other as by itself."""
        met = 0.75 * self.amplitude**2 * (2 * len(self.lines) - 1)
        return np.asarray((1 + self.share * met) * self._filter())

    def nonlinear_variance(self) -> Floats:
        """(lines,) by which the gain of a realisation differs: all triples of lines that fall on it."""
        signed = np.concatenate([-self.lines, self.lines])
        power = dict.fromkeys(self.lines.tolist(), 0.0)
        for triple in combinations_with_replacement(signed.tolist(), 3):
            line = sum(triple)
            if line not in power or any(-k in triple for k in triple):
                continue  # falls elsewhere, or has the phase of the line itself
            orders = factorial(3)
            for k in set(triple):
                orders //= factorial(triple.count(k))
            power[line] += (orders * self.share * self.amplitude**2 / 4) ** 2
        counted = np.array([power[k] for k in self.lines.tolist()])
        return np.asarray(counted * np.abs(self._filter()) ** 2)

    def period(self, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """One period of input and output, (period_ticks,) each, of freshly drawn phases."""
        spectrum = np.zeros(self.period_ticks // 2 + 1, np.complex128)
        turned = rng.uniform(0, 2 * np.pi, len(self.lines))
        spectrum[self.lines] = self.amplitude * np.exp(1j * turned) * self.period_ticks / 2
        u = np.fft.irfft(spectrum, self.period_ticks)
        z = np.fft.rfft(u + self.share * u**3)
        every = np.arange(len(z)) / (self.period_ticks * PERIOD_S)
        return u, np.fft.irfft(z * _response(*self.filter, every), self.period_ticks)

    def _filter(self) -> Complex:
        return _response(*self.filter, self.lines / (self.period_ticks * PERIOD_S))
