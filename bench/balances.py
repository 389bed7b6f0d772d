"""Balances of oil, energy and momentum over a replayed run, and bugs to plant in the plant."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Array, Record, entry, kernel
from rtcore.rig.derivatives import derivatives
from rtcore.rig.fluid import specific_volume
from rtcore.rig.integrate import settle_pressures
from rtcore.rig.ledger import (
    ACCOUNTS,
    ENERGY_IN,
    ENERGY_OUT,
    HEAT,
    IMPULSE,
    IMPULSE_PASSED,
    OIL_IN,
    OIL_OUT,
    contents,
    keep_books,
)
from rtcore.rig.plant import (
    F_CELL,
    F_FRICTION,
    F_HYDRAULIC,
    FLOWS,
    P_1,
    P_2,
    Q_BYPASS,
    STATES,
    V_1,
    V_B,
    V_R,
    X_B,
    X_R,
)

BUG = 0.01  # how wrong a planted bug is, where it is wrong by degrees


class Fault(IntEnum):
    """Bugs that a plant can have and still look well."""

    NONE = 0
    FLOW_FROM_NOWHERE = 1  # the bypass takes less from chamber 1 than chamber 2 gets
    ORIFICE_OFF_ITS_LAW = 2  # the bypass lets more through than its law says, on both sides
    OIL_TOO_STIFF = 3  # bulk modulus and density do not belong together
    AREA_OFF_ON_ONE_SIDE = 4  # chamber 2 is displaced by more than the piston pushes
    FRICTION_DRIVES = 5  # friction has the wrong sign
    NO_REACTION_ON_BODY = 6  # the load actuator's body does not feel its own oil
    CELL_WITHOUT_REACTION = 7  # mass 1 feels less than the load cell pushes


class Balance(NamedTuple):
    """The most that was ever missing in each book, as a share of all that went through it."""

    oil: float
    energy: float
    momentum: float


@kernel
def faulty_derivatives(plant: Record, y: Array, u: Array, q: Array, dy: Array, fault: int) -> None:
    """The plant's equations of motion, with a bug planted in them."""
    derivatives(plant, y, u, q, dy)
    v_1, slope_1 = specific_volume(plant, y[P_1])
    v_2, slope_2 = specific_volume(plant, y[P_2])
    stroke = plant.area_m2 * (y[X_R] - y[X_B])
    rise_1 = -v_1 / (slope_1 * (plant.volume_1_m3 + stroke))  # Pa/s for 1 m³/s
    rise_2 = -v_2 / (slope_2 * (plant.volume_2_m3 - stroke))
    if fault == Fault.FLOW_FROM_NOWHERE:
        dy[P_1] += rise_1 * v_1 * BUG * q[Q_BYPASS]
    elif fault == Fault.ORIFICE_OFF_ITS_LAW:
        more = BUG * q[Q_BYPASS]
        q[Q_BYPASS] += more
        dy[P_1] -= rise_1 * v_1 * more
        dy[P_2] += rise_2 * v_2 * more
    elif fault == Fault.OIL_TOO_STIFF:
        dy[P_1] *= 1.0 + BUG
    elif fault == Fault.AREA_OFF_ON_ONE_SIDE:
        dy[P_2] += rise_2 * BUG * plant.area_m2 * (y[V_R] - y[V_B])
    elif fault == Fault.FRICTION_DRIVES:
        dy[V_R] += 2.0 * q[F_FRICTION] / plant.m_la_kg
        dy[V_B] -= 2.0 * q[F_FRICTION] / plant.m_b_kg
    elif fault == Fault.NO_REACTION_ON_BODY:
        dy[V_B] += q[F_HYDRAULIC] / plant.m_b_kg
    elif fault == Fault.CELL_WITHOUT_REACTION:
        dy[V_1] -= BUG * q[F_CELL] / plant.m_1_kg


@kernel
def integrate(
    plant: Record, y: Array, u: Array, duration_s: float, steps: int, fault: int, books: Array
) -> None:
    """Carry `y` on by classical Runge-Kutta, and (ACCOUNTS,) `books` by the same stages."""
    q, z, dy = np.zeros(FLOWS), np.zeros(STATES), np.zeros(STATES)
    total, rates, passed = np.zeros(STATES), np.zeros(ACCOUNTS), np.zeros(ACCOUNTS)
    h = duration_s / steps
    for _ in range(steps):
        total[:] = 0.0
        passed[:] = 0.0
        z[:] = y
        for reach, weight in ((0.5, 1.0), (0.5, 2.0), (1.0, 2.0), (0.0, 1.0)):
            faulty_derivatives(plant, z, u, q, dy, fault)
            keep_books(plant, z, u, q, rates)
            total += weight / 6.0 * dy
            passed += weight / 6.0 * rates
            z[:] = y + reach * h * dy
        y += h * total
        books += h * passed
    settle_pressures(plant, y)


@entry
def replay(
    plant: Record,
    before: Array,
    inputs: Array,
    states: Array,
    duration_s: float,
    steps: int,
    fault: int,
    books: Array,
    worst: Array,
) -> None:
    """Keep the books over held inputs (n, INPUTS), and the (3,) worst that is missing in them.

    Where `states` (n, STATES) are given, each tick is replayed from the one given, so that what is
    missing is what the integrator that gave them has lost.
    """
    y = before.copy()
    first_oil, first_energy, first_momentum = contents(plant, y)
    for k in range(len(inputs)):
        integrate(plant, y, inputs[k], duration_s, steps, fault, books)
        if len(states) > 0:
            y[:] = states[k]
        oil, energy, momentum = contents(plant, y)
        oil -= first_oil + books[OIL_IN] - books[OIL_OUT]
        energy -= first_energy + books[ENERGY_IN] - books[ENERGY_OUT] - books[HEAT]
        momentum -= first_momentum + books[IMPULSE]
        worst[0] = max(worst[0], abs(oil))
        worst[1] = max(worst[1], abs(energy))
        worst[2] = max(worst[2], abs(momentum))


def balance(
    plant: Record,
    before: npt.NDArray[np.float64],
    inputs: npt.NDArray[np.float64],
    states: npt.NDArray[np.float64] | None = None,
    fault: Fault = Fault.NONE,
    period_s: float = 250e-6,
    steps: int = 8,
) -> Balance:
    """The balances of a run from its first state (STATES,) and held inputs (n, INPUTS).

    With `states` (n, STATES) they are those of the integrator that gave them, else of the equations
    of motion alone.
    """
    books, worst = np.zeros(ACCOUNTS), np.zeros(3)
    given = np.empty((0, STATES)) if states is None else states
    replay(plant, before, inputs, given, period_s, steps, int(fault), books, worst)
    energy = max(books[ENERGY_IN], books[ENERGY_OUT] + books[HEAT])
    through = (max(books[OIL_IN], books[OIL_OUT]), energy, books[IMPULSE_PASSED])
    shares = (float(w / t) if t > 0 else float(w) for w, t in zip(worst, through, strict=True))
    return Balance(*shares)
