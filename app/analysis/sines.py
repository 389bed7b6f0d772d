"""Amplitude, mean, phase and distortion of a force: a sine and its harmonics, by least squares.

Each stretch of cycles has φ = 0 where it began and is turned to the phase of its *recorded* setpoint
before it is added to the others, so it does not matter where a hold left the oscillator.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from app.analysis.evidence import Sine
from app.analysis.phasors import Complex, Phasors, solve
from app.analysis.walk import Part

CHANNELS = ("force_n", "force_command_n")
HALF_A_TICK = 0.5  # a whole cycle may end between ticks


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


@dataclass(frozen=True)
class SineSums:
    """The normal equations of one sine, of a stretch of cycles or of many: as those of `Phasors`."""

    force: Complex
    command: Complex
    ones: Complex

    @property
    def ticks(self) -> float:
        return float(self.ones[0].real)

    def added(self, other: "SineSums") -> "SineSums":
        """With another's ticks; both are in phase with their setpoint."""
        return SineSums(
            self.force + other.force, self.command + other.command, self.ones + other.ones
        )

    def turned(self) -> "SineSums":
        """The same with φ = 0 where the setpoint is at its top."""
        highest = len(self.command) - 1
        angle = float(np.angle(solve(self.command, self.ones)[highest + 1]))
        turn = np.exp(-1j * angle * np.arange(2 * highest + 1))
        below = turn[: highest + 1]
        return SineSums(self.force * below, self.command * below, self.ones * turn)


class SineFit:
    """Fits the sines of a run, stretch after stretch; what was fitted is kept for each sine."""

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._blocks: dict[int, dict[Sine, SineSums]] = {}
        self._now: Phasors | None = None
        self._of: tuple[int, Sine] | None = None

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever kind."""
        if part.begins:
            self._file()
        sine = part.stretch.sine
        if sine is None:
            return
        if self._now is None:
            self._of = part.stretch.block, sine
            began_at, first = int(part.columns["tick"][0]), int(part.positions[0])
            self._now = Phasors(CHANNELS, sine.frequency_hz * self._period_s, began_at, first)
        self._now.take(part.positions, part.columns)

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
                first, before = total.get(sine, (block, None))
                total[sine] = first, found if before is None else before.added(found)
        return [_read(block, sine, found) for sine, (block, found) in total.items()]

    def _file(self) -> None:
        """Put the stretch that has been fitted with those of the same sine."""
        now, self._now = self._now, None
        if now is None or self._of is None:
            return
        block, sine = self._of
        force, command = now.sums.sum(axis=1)
        found = SineSums(force, command, now.ones.sum(axis=0))
        if (found.ticks + HALF_A_TICK) * sine.frequency_hz * self._period_s < 1:
            return  # not one whole cycle
        sums = self._blocks.setdefault(block, {})
        before = sums.get(sine)
        sums[sine] = found.turned() if before is None else before.added(found.turned())


def _read(block: int, sine: Sine, sums: SineSums) -> FoundSine:
    parts, setpoint = solve(sums.force, sums.ones), solve(sums.command, sums.ones)
    middle = len(parts) // 2
    first = parts[middle + 1]
    higher = np.sqrt(np.sum(np.abs(parts[middle + 2 :]) ** 2))
    share = float(higher / abs(first)) if abs(first) > 0 else math.nan
    distortion = 100 * share if middle > 1 else None
    phase_deg = math.degrees(float(np.angle(first * np.conj(setpoint[middle + 1]))))
    return FoundSine(
        block, sine, float(2 * abs(first)), float(parts[middle].real), phase_deg, distortion
    )


def _harmonics(sums: SineSums) -> tuple[Harmonic, ...]:
    parts, setpoint = solve(sums.force, sums.ones), solve(sums.command, sums.ones)
    middle = len(parts) // 2
    orders = np.arange(1, middle + 1)
    turn = np.exp(-1j * orders * np.angle(setpoint[middle + 1]))
    amplitudes_n = 2 * np.abs(parts[middle + 1 :])
    phases_deg = np.degrees(np.angle(parts[middle + 1 :] * turn))
    shares = 100 * amplitudes_n / amplitudes_n[0] if amplitudes_n[0] > 0 else amplitudes_n * np.nan
    columns = (column.tolist() for column in (orders, amplitudes_n, phases_deg, shares))
    return tuple(Harmonic(*row) for row in zip(*columns, strict=True))
