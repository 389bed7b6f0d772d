"""Amplitude, mean, phase and distortion of a force: a sine and its harmonics, by least squares.

What is summed up are correlations with e^(−jkφ) and the same of 1: the normal equations of the fit.
Each stretch of cycles has φ = 0 where it began and is turned to the phase of its *recorded* setpoint
before it is added to the others, so it does not matter where a hold left the oscillator.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Sine
from app.analysis.walk import Part
from rtcore.compiled import entry

HIGHEST_HARMONIC = 10
HALF_A_TICK = 0.5  # a whole cycle may end between ticks
Complex = npt.NDArray[np.complex128]


class FoundSine(NamedTuple):
    """What the force did while the setpoint was a sine; `phase_deg` is negative where it lags."""

    block: int
    asked: Sine
    amplitude_n: float
    mean_n: float
    phase_deg: float
    distortion_percent: float | None  # None where no harmonic is below half the loop rate

    @property
    def amplitude_error_percent(self) -> float:
        """Amplitude above (+) or below (−) what was asked for, in % of that."""
        return 100 * (self.amplitude_n / self.asked.amplitude_n - 1)


class Harmonic(NamedTuple):
    """A multiple of a sine's frequency in the force.

    `phase_deg` is against the same multiple of the setpoint's phase, from −180 to 180: 0 where the two
    are highest together. `percent` is of the first harmonic.
    """

    order: int
    amplitude_n: float
    phase_deg: float
    percent: float


class SineSums:
    """The normal equations of one sine: of a stretch of cycles, or of many."""

    def __init__(self, harmonics: int) -> None:
        self.harmonics = harmonics
        self.force = np.zeros(harmonics + 1, np.complex128)
        self.command = np.zeros(2, np.complex128)
        self.ones = np.zeros(2 * harmonics + 1, np.complex128)

    @property
    def ticks(self) -> float:
        return float(self.ones[0].real)

    def add(self, other: "SineSums") -> None:
        """Add another's ticks; both are in phase with their setpoint."""
        self.force += other.force
        self.command += other.command
        self.ones += other.ones

    def turned(self) -> "SineSums":
        """The same with φ = 0 where the setpoint is at its top."""
        angle = float(np.angle(_solve(self.command, self.ones)[2]))
        made = SineSums(self.harmonics)
        turn = np.exp(-1j * angle * np.arange(2 * self.harmonics + 1))
        made.force = self.force * turn[: self.harmonics + 1]
        made.command = self.command * turn[:2]
        made.ones = self.ones * turn
        return made


class SineFit:
    """Fits the sines of a run, stretch after stretch; what was fitted is kept for each sine."""

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._blocks: dict[int, dict[Sine, SineSums]] = {}
        self._now: SineSums | None = None
        self._of: tuple[int, Sine] | None = None
        self._began_at = 0

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever kind."""
        if part.begins:
            self._file()
        sine = part.stretch.sine
        if sine is None:
            return
        if self._now is None:
            self._of = part.stretch.block, sine
            self._began_at = int(part.columns["tick"][0])
            self._now = SineSums(self._harmonics(sine))
        _correlate(
            self._now.force,
            self._now.command,
            self._now.ones,
            part.columns["tick"] - self._began_at,
            sine.frequency_hz * self._period_s,
            part.columns["force_n"],
            part.columns["force_command_n"],
        )

    def of_block(self, block: int) -> list[FoundSine]:
        """What the sines of a block amount to, each once, wherever in it they come."""
        self._file()
        sums = self._blocks.get(block, {})
        return [_read(block, sine, found) for sine, found in sums.items()]

    def harmonics_of_block(self, block: int) -> list[tuple[Harmonic, ...]]:
        """The harmonics of each of the sines `of_block`, from the first to the tenth at most."""
        self._file()
        return [_harmonics(found) for found in self._blocks.get(block, {}).values()]

    def of_run(self) -> list[FoundSine]:
        """What the sines of the run amount to, each once; `block` is the first that has it."""
        self._file()
        total: dict[Sine, tuple[int, SineSums]] = {}
        for block, sums in self._blocks.items():
            for sine, found in sums.items():
                total.setdefault(sine, (block, SineSums(found.harmonics)))[1].add(found)
        return [_read(block, sine, found) for sine, (block, found) in total.items()]

    def _harmonics(self, sine: Sine) -> int:
        below = math.ceil(0.5 / (sine.frequency_hz * self._period_s) - 1e-9) - 1
        return max(1, min(HIGHEST_HARMONIC, below))

    def _file(self) -> None:
        """Put the stretch that has been fitted with those of the same sine."""
        now, self._now = self._now, None
        if now is None or self._of is None:
            return
        block, sine = self._of
        if (now.ticks + HALF_A_TICK) * sine.frequency_hz * self._period_s < 1:
            return  # not one whole cycle
        sums = self._blocks.setdefault(block, {})
        sums.setdefault(sine, SineSums(now.harmonics)).add(now.turned())


def _read(block: int, sine: Sine, sums: SineSums) -> FoundSine:
    parts = _solve(sums.force, sums.ones)
    setpoint = _solve(sums.command, sums.ones)
    middle = sums.harmonics
    first = parts[middle + 1]
    higher = np.sqrt(np.sum(np.abs(parts[middle + 2 :]) ** 2))
    share = float(higher / abs(first)) if abs(first) > 0 else math.nan
    distortion = 100 * share if sums.harmonics > 1 else None
    phase_deg = math.degrees(float(np.angle(first * np.conj(setpoint[2]))))
    return FoundSine(
        block, sine, float(2 * abs(first)), float(parts[middle].real), phase_deg, distortion
    )


def _harmonics(sums: SineSums) -> tuple[Harmonic, ...]:
    parts = _solve(sums.force, sums.ones)[sums.harmonics + 1 :]
    turn = np.angle(_solve(sums.command, sums.ones)[2])
    orders = np.arange(1, len(parts) + 1)
    amplitudes_n = 2 * np.abs(parts)
    phases_deg = np.degrees(np.angle(parts * np.exp(-1j * turn * orders)))
    shares = 100 * amplitudes_n / amplitudes_n[0] if amplitudes_n[0] > 0 else amplitudes_n * np.nan
    return tuple(
        Harmonic(int(order), float(amplitude_n), float(phase_deg), float(share))
        for order, amplitude_n, phase_deg, share in zip(
            orders, amplitudes_n, phases_deg, shares, strict=True
        )
    )


def _solve(correlations: Complex, ones: Complex) -> Complex:
    """(2K+1,) parts c of y = Σ c_k e^(jkφ), k from −K to K, from Σ y e^(−jkφ), k from 0 to K."""
    highest = len(correlations) - 1
    k = np.arange(-highest, highest + 1)
    apart = k[:, None] - k[None, :]
    matrix = np.where(apart >= 0, ones[np.abs(apart)], np.conj(ones[np.abs(apart)]))
    right = np.concatenate([np.conj(correlations[:0:-1]), correlations])
    if not np.isfinite(right).all():
        return np.full(2 * highest + 1, np.nan + 0j)
    return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-10)[0])


@entry
def _correlate(
    force: Complex,
    command: Complex,
    ones: Complex,
    ticks: npt.NDArray[np.int64],
    cycles_per_tick: float,
    force_n: npt.NDArray[np.float32],
    command_n: npt.NDArray[np.float32],
) -> None:
    highest = len(force) - 1
    for i in range(len(ticks)):
        turned = cycles_per_tick * ticks[i]
        angle = 2.0 * math.pi * (turned - math.floor(turned))
        step = complex(math.cos(angle), -math.sin(angle))
        power = complex(1.0, 0.0)
        y, u = np.float64(force_n[i]), np.float64(command_n[i])
        for k in range(2 * highest + 1):
            ones[k] += power
            if k <= highest:
                force[k] += y * power
            if k <= 1:
                command[k] += u * power
            power *= step
