"""Whether a rig has settled at a sine: cycle after cycle the same response."""

import math

import numpy as np

from app.analysis.walk import Part

STEADY = 0.01  # of the response from one cycle to the next: 0.09 dB or 0.6°


class CycleByCycle:
    """Force over setpoint of each cycle, by the correlation of both with the sine over that cycle."""

    def __init__(self, cycles_per_tick: float, at_least: int) -> None:
        self._per_tick = cycles_per_tick
        self._at_least = max(at_least, 2)
        self._begun: int | None = None
        self._number = 0
        self._sums = np.zeros(2, np.complex128)
        self._last: list[complex] = []

    @property
    def is_steady(self) -> bool:
        """Whether the last two of enough cycles are alike."""
        if self._number < self._at_least or len(self._last) < 2:
            return False
        before, now = self._last
        return abs(now - before) <= STEADY * abs(now)

    def take(self, part: Part) -> None:
        """The next ticks of settling."""
        if self._begun is None:
            self._begun = int(part.positions[0])
        turned = (part.positions - self._begun) * self._per_tick
        numbers = np.floor(turned + 1e-9).astype(np.int64)
        for number in range(int(numbers[0]), int(numbers[-1]) + 1):
            if number > self._number:
                self._close(number)
            now = numbers == number
            wave = np.exp(-2j * math.pi * turned[now])
            for i, name in enumerate(("force_command_n", "force_n")):
                self._sums[i] += wave @ part.columns[name][now].astype(np.float64)

    def _close(self, number: int) -> None:
        setpoint, force = self._sums
        if setpoint != 0:
            self._last = [*self._last[-1:], complex(force / setpoint)]
        self._number = number
        self._sums = np.zeros(2, np.complex128)
