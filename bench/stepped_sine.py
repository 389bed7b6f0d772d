"""Closed-loop frequency response by stepped sines of the very tick, and where it peaks and dips."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from app.controller.settings import ControllerSettings
from bench.recorded import begin, make_test, ready_rig, states_of, true_force
from bench.references import PERIOD_S
from bench.sines import decibels, fundamental
from rtcore.modes import Mode
from rtcore.rig.parameters import RigParameters

SETTLE_S, MEASURE_S = 0.25, 0.4
LEAST_CYCLES = 10
TAPER_CYCLES = 2


class Extreme(NamedTuple):
    """A peak or a dip of a frequency response."""

    frequency_hz: float
    gain_db: float


@dataclass
class SteppedSine:
    """Gain in dB, true force to setpoint, of sines about a mean; each frequency from rest."""

    rig: RigParameters
    amplitude_n: float
    mean_n: float = 0.0
    controller: ControllerSettings | None = None
    seed: int = 1
    _known: dict[float, float] = field(default_factory=dict, repr=False)

    def gain_db(self, frequency_hz: float) -> float:
        """Raises RuntimeError where the rig trips."""
        if frequency_hz not in self._known:
            self._known[frequency_hz] = self._measure(frequency_hz)
        return self._known[frequency_hz]

    def peak(self, low_hz: float, high_hz: float) -> Extreme:
        """The highest gain between two frequencies."""
        return self._extreme(low_hz, high_hz, lambda f: -self.gain_db(f))

    def dip(self, low_hz: float, high_hz: float) -> Extreme:
        """The lowest gain between two frequencies."""
        return self._extreme(low_hz, high_hz, self.gain_db)

    def _extreme(self, low_hz: float, high_hz: float, lower: Callable[[float], float]) -> Extreme:
        grid = np.arange(low_hz, high_hz + 1e-9, 2.5)
        best = float(min(grid, key=lower))
        bounds = max(low_hz, best - 2.5), min(high_hz, best + 2.5)
        found = minimize_scalar(lower, bounds=bounds, method="bounded", options={"xatol": 0.05})
        return Extreme(float(found.x), self.gain_db(float(found.x)))

    def _measure(self, frequency_hz: float) -> float:
        settle_s = max(LEAST_CYCLES / frequency_hz, SETTLE_S)
        measure_s = max(LEAST_CYCLES / frequency_hz, MEASURE_S)
        virtual = ready_rig(self.rig, self.controller, self.seed)
        sine = {
            "kind": "harmonic",
            "mean_n": self.mean_n,
            "amplitude_n": self.amplitude_n,
            "frequency_hz": frequency_hz,
            "duration_s": settle_s + measure_s + 0.1,
            "taper_cycles": TAPER_CYCLES,
        }
        begin(virtual, make_test([sine]))
        virtual.advance(round((TAPER_CYCLES / frequency_hz + settle_s) / PERIOD_S))
        records, states = states_of(virtual, round(measure_s / PERIOD_S))
        if virtual.mode is not Mode.RUNNING:
            raise RuntimeError(f"{self.amplitude_n} N at {frequency_hz} Hz: {virtual.mode.name}")
        force = fundamental(true_force(self.rig, states), frequency_hz, PERIOD_S)
        setpoint = records["force_command_n"].astype(np.float64) - self.mean_n
        return decibels(force / fundamental(setpoint, frequency_hz, PERIOD_S))
