"""The plant linearised: state space by differentiating its equations of motion, and frequency response."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from rtcore.compiled import Array, Record, kernel
from rtcore.rig.derivatives import derivatives
from rtcore.rig.integrate import WORK, advance
from rtcore.rig.plant import (
    DY_F,
    F_CELL,
    FLOWS,
    G_S,
    G_T,
    INPUTS,
    P_1,
    P_2,
    P_S,
    P_T,
    STATES,
    V_F,
    V_T,
    X_F,
    X_S,
    Y_F,
    Y_V,
)

Complex = npt.NDArray[np.complex128]

# What the state space gives: true force in the load cell (N), what its and the LVT's chains make of it
# (N, m/s), and the velocity of the unit's own output (m/s).
FORCE, FORCE_READ, VELOCITY_READ, UNIT_VELOCITY = 0, 1, 2, 3
OUTPUTS = 4

# Steps of the differentiation: far below what bends each law (friction's turn of 1e-3 m/s, the lands'
# clearance of 4e-6 m, the bypass's laminar range of 500 Pa), far above what rounding leaves.
_STEPS = np.full(STATES, 1e-8)
_STEPS[[X_F, V_F, X_S]] = 1e-5, 1e-2, 1e-9
_STEPS[[P_1, P_2, P_S, P_T]] = 0.1
_STEPS[[Y_F, DY_F, Y_V]] = 1.0, 1e3, 1e-5
_STEPS[[G_S, G_T]] = 1e-9
_INPUT_STEPS = np.array([1e-6, 1e-7, 1.0, 1e-6])


@dataclass(frozen=True)
class StateSpace:
    """x' = A x + B u, y = C x: (STATES, STATES), (STATES, INPUTS), (OUTPUTS, STATES) float64."""

    a: Array
    b: Array
    c: Array

    def response(self, frequency_hz: float) -> Complex:
        """(OUTPUTS, INPUTS): the outputs to sines at the inputs."""
        return _response(self.a, self.b, self.c, 2j * np.pi * frequency_hz)

    def sampled(self, period_s: float) -> "Sampled":
        """The same with inputs held for a period and outputs read at its end."""
        n, inputs = self.b.shape
        both = np.zeros((n + inputs, n + inputs))
        both[:n, :n], both[:n, n:] = self.a, self.b
        e = expm(both * period_s)
        return Sampled(e[:n, :n], e[:n, n:], self.c, period_s)


@dataclass(frozen=True)
class Sampled:
    """x⁺ = A x + B u, y = C x, a period later."""

    a: Array
    b: Array
    c: Array
    period_s: float

    def response(self, frequency_hz: float) -> Complex:
        """(OUTPUTS, INPUTS): the sampled outputs to sampled sines at the inputs."""
        z = np.exp(2j * np.pi * frequency_hz * self.period_s)
        return _response(self.a, self.b, self.c, z)


def _response(a: Array, b: Array, c: Array, at: complex) -> Complex:
    return np.asarray(c @ np.linalg.solve(at * np.eye(len(a)) - a, b))


@kernel
def _slopes(plant: Record, y: Array, u: Array, dy: Array) -> float:
    q = np.zeros(FLOWS)
    derivatives(plant, y, u, q, dy)
    return q[F_CELL]


def linearise(plant: Record, y: Array, u: Array, spool_step_m: float = _STEPS[X_S]) -> StateSpace:
    """The plant about a state (STATES,) and inputs (INPUTS,), by central differences.

    A large `spool_step_m` gives the lands' gain over that opening instead of at a point.
    """
    a, c = np.empty((STATES, STATES)), np.zeros((OUTPUTS, STATES))
    b = np.empty((STATES, INPUTS))
    steps = _STEPS.copy()
    steps[X_S] = spool_step_m
    for i, step in enumerate(steps):
        a[:, i], c[FORCE, i] = _difference(plant, y, u, y, i, step)
    for i, step in enumerate(_INPUT_STEPS):
        b[:, i], _ = _difference(plant, y, u, u, i, step)
    c[FORCE_READ, Y_F] = 1.0
    c[VELOCITY_READ, Y_V] = 1.0
    c[UNIT_VELOCITY, V_T] = 1.0
    return StateSpace(a, b, c)


def _difference(
    plant: Record, y: Array, u: Array, moved: Array, place: int, step: float
) -> tuple[Array, float]:
    """Slope of (dy/dt, force) along one component of `moved`, which is `y` or `u`."""
    ends = []
    before = moved[place]
    for side in (step, -step):
        moved[place] = before + side
        dy = np.empty(STATES)
        force_n = _slopes(plant, y, u, dy)
        ends.append((dy, force_n, moved[place]))
    moved[place] = before
    (high, force_high, at_high), (low, force_low, at_low) = ends
    width = at_high - at_low
    return (high - low) / width, (force_high - force_low) / width


def settle(plant: Record, y: Array, u: Array, duration_s: float = 3.0) -> Array:
    """The state in which the plant comes to rest under held inputs, from `y`."""
    work = np.zeros(1, WORK)[0]
    y = y.copy()
    for _ in range(round(duration_s / 1e-3)):
        advance(plant, y, u, work, 1e-3, 16)
    return y
