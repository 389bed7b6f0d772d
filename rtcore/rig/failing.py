"""What the faults do to the simulated rig: to its plant where they come and go, to its signals every tick.

Amounts are looked at each tick; where none has changed and none is there, that is all that happens.
"""

import math
from typing import Any

import numpy as np

from rtcore.compiled import Array, Record, kernel
from rtcore.io import FAULT_SLOTS
from rtcore.rig.faults import KINDS, Fault, amount_within
from rtcore.rig.fluid import tabulate_fluid
from rtcore.rig.plant import (
    DY_F,
    FLUID_POINTS,
    P_1,
    P_2,
    U_BLEED,
    U_PUMP,
    U_VALVE,
    V_1,
    V_2,
    V_R,
    V_T,
    X_1,
    X_2,
    X_R,
    X_T,
    Y_F,
)
from rtcore.rig.sensors import quantise

AIRY = 0.05  # free air in the oil, share of volume

# Parameters of the plant that faults change.
_CHANGED = ("spool_rate_m_s", "spool_stop_k", "null_m", "k_tra", "c_tra", "alpha")

FAILING = np.dtype(
    [
        ("asked", "f8", (FAULT_SLOTS,)),  # by `Fault`, 0 for none
        ("amounts", "f8", (FAULT_SLOTS,)),  # the same within bounds
        ("present", "i8"),  # how many faults there are
        ("drift_n", "f8"),
        # what is right, to be put back
        *((name, "f8") for name in _CHANGED),
        ("force_noise_n", "f8"),
        ("sound_table", "f8", (FLUID_POINTS, 2)),
        ("airy_table", "f8", (FLUID_POINTS, 2)),
    ],
    align=True,
)


def remember_what_is_right(failing: Any, plant: Any, sensors: Any) -> None:
    """Keep what faults will change, and tabulate the oil with air in it: no tick has time for that."""
    for name in _CHANGED:
        failing[name] = plant[name]
    failing["force_noise_n"] = sensors["force_noise_n"]
    failing["sound_table"] = plant["fluid_table"]
    airy = plant.copy()
    airy["alpha"] = AIRY
    tabulate_fluid(airy)
    failing["airy_table"] = airy["fluid_table"]


@kernel
def take_faults(world: Record, injected: Array) -> None:
    """Bring the rig to the amounts that are asked for, (FAULT_SLOTS,) by `Fault`."""
    failing = world.failing
    for kind in range(1, KINDS):
        asked = injected[kind]
        if asked == failing.asked[kind]:
            continue
        failing.present += int(asked != 0.0) - int(failing.asked[kind] != 0.0)
        failing.asked[kind] = asked
        held = amount_within(kind, asked)
        failing.amounts[kind] = held
        _change(world, kind, held)


@kernel
def _change(world: Record, kind: int, amount: float) -> None:
    """The plant with this amount of one fault."""
    plant, right = world.plant, world.failing
    if kind == Fault.LOAD_CELL_NOISE:
        world.sensors.force_noise_n = right.force_noise_n * (amount if amount != 0.0 else 1.0)
    elif kind == Fault.LOAD_CELL_DRIFT and amount == 0.0:
        right.drift_n = 0.0
    elif kind == Fault.VALVE_STUCK:
        moves = amount == 0.0
        plant.spool_rate_m_s = right.spool_rate_m_s if moves else 0.0
        plant.spool_stop_k = right.spool_stop_k if moves else 0.0
    elif kind == Fault.VALVE_NULL_SHIFT:
        plant.null_m = right.null_m + amount
    elif kind == Fault.AIR_IN_OIL:
        plant.alpha = AIRY if amount != 0.0 else right.alpha
        plant.fluid_table[:] = right.airy_table if amount != 0.0 else right.sound_table
    elif kind == Fault.SPECIMEN_BROKEN:
        if amount == 0.0:
            _fit_new_specimen(world.y)
        plant.k_tra = 0.0 if amount != 0.0 else right.k_tra
        plant.c_tra = 0.0 if amount != 0.0 else right.c_tra


@kernel
def _fit_new_specimen(y: Array) -> None:
    """As a fitter leaves it: the chain stands at the unit, at its speed, and nothing pushes.

    Closing the joint where the pieces lie would be a blow of 60 kN for each millimetre between them.
    """
    for i in (X_R, X_1, X_2):
        y[i] = y[X_T]
    for i in (V_R, V_1, V_2):
        y[i] = y[V_T]
    y[P_1] = y[P_2] = 0.5 * (y[P_1] + y[P_2])
    y[Y_F] = y[DY_F] = 0.0


@kernel
def spoil_plant_inputs(amounts: Array, plant: Record, u: Array) -> None:
    """What reaches the plant, whatever the loop asks."""
    if amounts[Fault.VALVE_HARD_OVER] != 0.0:
        u[U_VALVE] = amounts[Fault.VALVE_HARD_OVER]
    chain_open = amounts[Fault.CHAIN_OPEN] != 0.0
    if chain_open or amounts[Fault.PUMP_LOSS] != 0.0:
        u[U_PUMP] = plant.tank_pa
    if chain_open:  # the chain takes the supply off and asks no software
        u[U_BLEED] = 1.0


@kernel
def spoil_sensors(
    failing: Record,
    sensors: Record,
    inputs: Record,
    force_before_n: float,
    velocity_before_m_s: float,
    period_s: float,
) -> None:
    """What reaches the loop of the `inputs` just read, and of what it was given before."""
    amounts, codes = failing.amounts, sensors.half_codes
    force = inputs.force_n
    if amounts[Fault.LOAD_CELL_SIGN] != 0.0:
        force = -force
    failing.drift_n += amounts[Fault.LOAD_CELL_DRIFT] * period_s
    if failing.drift_n != 0.0:
        force += failing.drift_n
    if amounts[Fault.LOAD_CELL_OPEN] != 0.0:
        force = math.copysign(math.inf, amounts[Fault.LOAD_CELL_OPEN])
    force = quantise(force, sensors.force_lsb_n, codes)
    if amounts[Fault.LOAD_CELL_FROZEN] != 0.0:
        force = force_before_n
    if amounts[Fault.LOAD_CELL_NAN] != 0.0:
        force = math.nan
    inputs.force_n = force
    if amounts[Fault.LVT_FROZEN] != 0.0:
        inputs.velocity_m_s = velocity_before_m_s
    if amounts[Fault.LVDT_OPEN] != 0.0:
        rail = math.copysign(math.inf, amounts[Fault.LVDT_OPEN])
        inputs.displacement_m = quantise(rail, sensors.displacement_lsb_m, codes)
    inputs.chain = int(amounts[Fault.CHAIN_OPEN] == 0.0)


@kernel
def lateness_ns(world: Record) -> int:
    """How long the I/O keeps the processor in each tick."""
    return int(world.failing.amounts[Fault.LATE_TICKS] * 1e9)
