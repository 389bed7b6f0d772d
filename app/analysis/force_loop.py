"""The force loop on the linear rig: open, closed, and what a motion of the unit does to it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from app.analysis.response.margins import Margins, followed, margins_of
from rtcore.control.response import (
    compensation_response,
    feed_forward_response,
    pid_response,
    shift,
)
from rtcore.rig.linear import (
    FORCE,
    FORCE_READ,
    UNIT_VELOCITY,
    VELOCITY_READ,
    Sampled,
    StateSpace,
)
from rtcore.rig.plant import U_UNIT, U_VALVE

Floats = npt.NDArray[np.float64]
Complexes = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class ForceLoop:
    """The linear rig under the control law: a GAINS record, the load's frequency where it has one.

    Without `load_hz` the compensation is left out.
    """

    rig: StateSpace
    gains: Any
    period_s: float
    load_hz: float | None = None

    @cached_property
    def _sampled(self) -> Sampled:
        return self.rig.sampled(self.period_s)

    def open_loop(self, frequency_hz: float) -> complex:
        """L = C P - W P_v, with the tick of delay and the hold."""
        return complex(self.open_loops(np.array([frequency_hz]))[0])

    def closed_loop(self, frequency_hz: float) -> complex:
        """True force to setpoint."""
        return complex(self.closed_loops(np.array([frequency_hz]))[0])

    def open_loops(self, frequencies_hz: Floats) -> Complexes:
        """L at (n,) frequencies."""
        return self._open(frequencies_hz, self._held(frequencies_hz))

    def closed_loops(self, frequencies_hz: Floats) -> Complexes:
        """True force to setpoint at (n,) frequencies."""
        held, shifts = self._held(frequencies_hz), self._shifts(frequencies_hz)
        forward = np.array(
            [
                pid_response(self.gains, z, self.period_s)
                + feed_forward_response(self.gains, z, self.period_s)
                for z in shifts
            ]
        )
        return np.asarray(forward * held[:, FORCE] / (1.0 + self._open(frequencies_hz, held)))

    def disturbances(self, frequencies_hz: Floats) -> Complexes:
        """What the load cell reads of the velocity of the unit's output (N s/m), at (n,) frequencies.

        (D - W (P_v D - P D_v))/(1 + L), without setpoint.
        """
        held = self._held(frequencies_hz)
        d, d_v = _moved(self.rig, frequencies_hz)
        w = self._compensation(frequencies_hz)
        told = w * (held[:, VELOCITY_READ] * d - held[:, FORCE_READ] * d_v)
        return np.asarray((d - told) / (1.0 + self._open(frequencies_hz, held)))

    def margins(self, from_hz: float = 5.0, to_hz: float = 400.0, points: int = 1000) -> Margins:
        """Margins of the open loop between two frequencies; NaN where it does not cross."""
        return margins_of(
            *followed(self.open_loops, np.geomspace(from_hz, to_hz, points)), self.open_loop
        )

    def _shifts(self, frequencies_hz: Floats) -> Complexes:
        return np.array([shift(f, self.period_s) for f in frequencies_hz])

    def _held(self, frequencies_hz: Floats) -> Complexes:
        """(n, outputs) to the valve command, the tick of delay and the hold included."""
        shifts = self._shifts(frequencies_hz)
        found = responses(self._sampled.a, self._sampled.b, self._sampled.c, shifts)
        return np.asarray(found[:, :, U_VALVE] / shifts[:, None])

    def _compensation(self, frequencies_hz: Floats) -> Complexes:
        if self.load_hz is None:
            return np.zeros(len(frequencies_hz), np.complex128)
        at = self._shifts(frequencies_hz)
        return np.array(
            [compensation_response(self.gains, self.load_hz, z, self.period_s) for z in at]
        )

    def _open(self, frequencies_hz: Floats, held: Complexes) -> Complexes:
        at = self._shifts(frequencies_hz)
        forward = np.array([pid_response(self.gains, z, self.period_s) for z in at])
        back = self._compensation(frequencies_hz) * held[:, VELOCITY_READ]
        return np.asarray(forward * held[:, FORCE_READ] - back)


def responses(a: Floats, b: Floats, c: Floats, at: Complexes) -> Complexes:
    """(n, outputs, inputs): C (z - A)⁻¹ B at (n,) values of z, or of s."""
    inverse = np.linalg.solve(at[:, None, None] * np.eye(len(a)) - a, b[None].astype(complex))
    return np.asarray(c @ inverse)


def _moved(rig: StateSpace, frequencies_hz: Floats) -> tuple[Complexes, Complexes]:
    """D and D_v: what load cell and LVT read of the velocity of the unit's output, the valve held."""
    found = responses(rig.a, rig.b, rig.c, np.asarray(2j * np.pi * frequencies_hz))[:, :, U_UNIT]
    d, d_v = found[:, FORCE_READ], found[:, VELOCITY_READ]
    return d / found[:, UNIT_VELOCITY], d_v / found[:, UNIT_VELOCITY]


def exact_compensation(rig: StateSpace, frequency_hz: float, period_s: float) -> complex:
    """W (s/m) with which a motion of the unit moves the force no more, at one frequency.

    W = -D/(P D_v - D P_v): P and P_v are load cell and LVT to valve command, delay and hold included;
    D and D_v the same to the unit's velocity.
    """
    sampled = rig.sampled(period_s).response(frequency_hz)
    held = sampled[:, U_VALVE] / shift(frequency_hz, period_s)
    moved = rig.response(frequency_hz)[:, U_UNIT]
    d, d_v = moved[[FORCE_READ, VELOCITY_READ]] / moved[UNIT_VELOCITY]
    return complex(-d / (held[FORCE_READ] * d_v - d * held[VELOCITY_READ]))
