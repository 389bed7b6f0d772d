"""The plant's equations of motion handed to scipy's solvers, restarted at every tick as its inputs are held."""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
import numpy.typing as npt
from scipy.integrate import odeint, solve_ivp

from rtcore.compiled import Array, Record, address_of, carray, entry, kernel, pointer
from rtcore.rig.derivatives import derivatives
from rtcore.rig.integrate import WORK, advance
from rtcore.rig.plant import FLOWS, INPUTS, PLANT, STATES

Floats = npt.NDArray[np.float64]
PERIOD_S = 250e-6

# What counts as large for each state, so that an error of 1e-10 is of that.
SCALE = np.array([1.0, 1e3, 1e-4, *[1e6] * 3, 1e5, *[1e-5, 1e-2] * 5, 1e3, 1e6, 1e-2, 1e-4, 1e-4])


@kernel
def slopes(y: Array, t: float, plant_address: int, inputs_address: int) -> Array:
    """(STATES,) dy/dt. By address, a call from Python costs a sixth of one that hands over the record."""
    plant = carray(pointer(plant_address), 1, PLANT)[0]
    u = carray(pointer(inputs_address), INPUTS, np.float64)
    q, dy = np.empty(FLOWS), np.empty(STATES)
    derivatives(plant, y, u, q, dy)
    return dy


@kernel
def jacobian(y: Array, plant_address: int, inputs_address: int, scale: Array) -> Array:
    """(STATES, STATES) by forward differences: for Newton's iteration, whose result it does not change."""
    at, moved = slopes(y, 0.0, plant_address, inputs_address), y.copy()
    j = np.empty((STATES, STATES))
    for i in range(STATES):
        step = 1e-7 * max(abs(y[i]), scale[i])
        moved[i] = y[i] + step
        j[:, i] = (slopes(moved, 0.0, plant_address, inputs_address) - at) / step
        moved[i] = y[i]
    return j


class HeldPlant:
    """A plant and the inputs (INPUTS,) that are held in it, for solvers to call."""

    def __init__(self, plant: Any) -> None:
        self._plants = np.zeros(1, PLANT)
        self._plants[0] = plant
        self.inputs = np.zeros(INPUTS)
        self.addresses = address_of(self._plants), address_of(self.inputs)

    def slopes(self, t: float, y: Floats) -> Floats:
        """(STATES,) dy/dt."""
        return np.asarray(slopes(y, t, *self.addresses))

    def jacobian(self, t: float, y: Floats) -> Floats:
        """(STATES, STATES)."""
        return np.asarray(jacobian(y, *self.addresses, SCALE))


TickSolver = Callable[
    [HeldPlant, Floats, float], Floats
]  # plant, state, tolerance → state a tick on


def radau(plant: HeldPlant, y: Floats, tolerance: float) -> Floats:
    """By scipy's implicit Radau method of order 5. Raises RuntimeError where it gives up."""
    found = solve_ivp(
        plant.slopes,
        (0.0, PERIOD_S),
        y,
        method="Radau",
        rtol=tolerance,
        atol=tolerance * np.maximum(np.abs(y), SCALE),
        jac=plant.jacobian,
    )
    if not found.success:
        raise RuntimeError(found.message)
    return np.asarray(found.y[:, -1])


def lsoda(plant: HeldPlant, y: Floats, tolerance: float) -> Floats:
    """By LSODA behind scipy's interface of today."""
    span, atol = (0.0, PERIOD_S), tolerance * SCALE
    found = solve_ivp(plant.slopes, span, y, method="LSODA", rtol=tolerance, atol=atol)
    return np.asarray(found.y[:, -1])


def odeint_lsoda(plant: HeldPlant, y: Floats, tolerance: float) -> Floats:
    """By LSODA behind scipy's interface of old, which goes from step to step without Python."""
    ends, atol = np.array([0.0, PERIOD_S]), tolerance * SCALE
    solve = cast("Any", odeint)  # whose types know no arguments that are addresses
    found = solve(slopes, y, ends, args=plant.addresses, rtol=tolerance, atol=atol)
    return np.asarray(found[1])


def solver_states(
    solver: TickSolver, plant: Any, before: Floats, inputs: Floats, tolerance: float
) -> Floats:
    """(n, STATES) after each tick, from (STATES,) under (n, INPUTS), by one of the solvers above."""
    held, y = HeldPlant(plant), before
    states = np.empty((len(inputs), STATES))
    for k, u in enumerate(inputs):
        held.inputs[:] = u
        y = states[k] = solver(held, y, tolerance)
    return states


@entry
def _tick_states(plant: Record, y: Array, inputs: Array, work: Record, steps: int) -> Array:
    states = np.empty((len(inputs), STATES))
    for k in range(len(inputs)):
        advance(plant, y, inputs[k], work, 250e-6, steps)
        states[k] = y
    return states


def own_states(plant: Any, before: Floats, inputs: Floats, steps: int) -> Floats:
    """(n, STATES) after each tick, by the loop's own integrator with so many steps a tick."""
    return np.asarray(_tick_states(plant, before.copy(), inputs, np.zeros(1, WORK)[0], steps))
