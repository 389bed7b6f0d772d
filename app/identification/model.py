"""The rig model driven by what was recorded: the same plant and integrator as the simulated rig's, without a loop."""

from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Array, entry
from rtcore.rig.constants import plant_constants
from rtcore.rig.integrate import WORK, advance, settle_gas
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import (
    INPUTS,
    P_1,
    P_2,
    P_S,
    P_T,
    STATES,
    SUBSTEPS,
    U_PUMP,
    U_UNIT,
    U_VALVE,
    V_1,
    V_2,
    V_R,
    V_T,
    X_1,
    X_2,
    X_B,
    X_R,
    X_S,
    X_T,
    Y_F,
    Y_V,
)

Floats = npt.NDArray[np.float64]

# The channels that the model is held against, in the order of its columns.
MEASURED = (
    "spool_position",
    "pressure_1_pa",
    "pressure_2_pa",
    "supply_pressure_pa",
    "force_n",
    "velocity_m_s",
    "displacement_m",
)
DRIVING = ("valve_command", "displacement_command_m")
SPOOL, PRESSURE_1, PRESSURE_2, SUPPLY, FORCE, VELOCITY, DISPLACEMENT = range(len(MEASURED))
DELAY_TICKS = 2  # from the tick that records a command to the first that records what it did


@entry
def follow(
    plants: npt.NDArray[Any],
    works: npt.NDArray[Any],
    y: Array,
    pump_pa: float,
    driving: Array,
    period_s: float,
    found: Array,
) -> None:
    """Carry the state `y` through (n, 2) valve and unit commands; (n, 7) `found` is what the sensors would see."""
    plant, work = plants[0], works[0]
    u = np.zeros(INPUTS)
    u[U_PUMP] = pump_pa
    for k in range(len(driving)):
        u[U_VALVE], u[U_UNIT] = driving[k, 0], driving[k, 1]
        advance(plant, y, u, work, period_s, SUBSTEPS)
        found[k, 0] = y[X_S] / plant.spool_stroke_m
        found[k, 1], found[k, 2], found[k, 3] = y[P_1], y[P_2], y[P_S]
        found[k, 4], found[k, 5], found[k, 6] = y[Y_F], y[Y_V], y[X_T]


class Model:
    """A rig ready to be driven. Safe for threads: each call has a state of its own."""

    def __init__(self, rig: RigParameters, period_s: float) -> None:
        self.rig = rig
        self._period_s = period_s
        self._plants = np.zeros(1, plant_constants(rig).dtype)
        self._plants[0] = plant_constants(rig)

    def driven(self, start: Floats, driving: Floats) -> Floats:
        """(n, 7) `MEASURED` under (n, 2) `DRIVING`, from what was measured at the start, (8,) with the speed."""
        y = self._at_rest_under(start)
        found = np.empty((len(driving), len(MEASURED)))
        works = np.zeros(1, WORK)
        follow(self._plants, works, y, self.rig.supply.high_pa, driving, self._period_s, found)
        return found

    def _at_rest_under(self, start: Floats) -> Floats:
        """The state in which a chain under this load moves as one with the unit: what is wrong in it dies out."""
        plant = self._plants[0]
        force_n, speed_m_s = start[FORCE], start[-1]
        y = np.zeros(STATES)
        y[X_S] = start[SPOOL] * plant["spool_stroke_m"]
        y[[P_1, P_2, P_S, P_T]] = *start[[PRESSURE_1, PRESSURE_2, SUPPLY]], plant["tank_pa"]
        settle_gas(plant, y)
        y[X_T] = start[DISPLACEMENT]
        y[X_2] = y[X_T] + force_n / plant["k_tra"]
        y[X_1] = y[X_2] + force_n / plant["k_2"]
        y[X_R] = y[X_1] + force_n / plant["k_lc"]
        y[X_B] = -force_n / plant["k_pl"]
        y[[V_R, V_1, V_2, V_T, Y_V]] = speed_m_s
        y[Y_F] = force_n
        return y
