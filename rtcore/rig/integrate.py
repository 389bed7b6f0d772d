"""The plant over one tick, inputs held: classical Runge-Kutta, in steps as fine as each part needs.

The valve depends on nothing behind it, so it moves first, and finer where it meets its stops. Where the piston
turns round within the tick, friction asks for finer steps of the rest.
"""

import numpy as np

from rtcore.compiled import Array, Record, inlined, kernel
from rtcore.rig.derivatives import rig_derivatives
from rtcore.rig.plant import (
    FLOWS,
    G_S,
    G_T,
    P_1,
    P_S,
    P_T,
    STATES,
    U_VALVE,
    V_B,
    V_F,
    V_R,
    X_F,
    X_S,
)
from rtcore.rig.servovalve import spool_motion

WORK = np.dtype(
    [
        ("q", "f8", (FLOWS,)),
        *((k, "f8", (STATES,)) for k in ("k1", "k2", "k3", "k4", "z")),
        ("finer_ticks", "i8"),  # how much longer friction asks for finer steps
    ],
    align=True,
)
REST = P_1  # the states from here on are behind the spool
NEAR_STOP = 0.8  # of the flapper's travel
FINER_AT_STOP = 3
FINER_AT_TURN = 2
TURN = 8.0  # widths of the friction's turn, on either side
FAST_TURN = 2.0  # widths a tick: from here on a turn rings the chain of masses
RING_TICKS = 14  # 3.5 ms


@kernel
def settle_gas(plant: Record, y: Array) -> None:
    """Set the gas volumes to what belongs to these pressures; what the hoses lack counts as gas."""
    y[G_S] = plant.accumulator_supply_m3
    if y[P_S] > plant.precharge_supply_pa:
        y[G_S] *= (plant.precharge_supply_pa / y[P_S]) ** (1.0 / plant.accumulator_n)
    else:
        y[G_S] += plant.hose_m3_pa * (plant.precharge_supply_pa - y[P_S])
    y[G_T] = plant.accumulator_return_m3 * (plant.precharge_return_pa / y[P_T]) ** (
        1.0 / plant.accumulator_n
    )


@kernel
def settle_pressures(plant: Record, y: Array) -> None:
    """Set supply and return pressure to what belongs to these gas volumes, which keep the oil's books exactly."""
    lacking = y[G_S] - plant.accumulator_supply_m3
    if lacking < 0.0:
        squeezed = plant.accumulator_supply_m3 / y[G_S]
        y[P_S] = plant.precharge_supply_pa * squeezed**plant.accumulator_n
    else:
        y[P_S] = plant.precharge_supply_pa - lacking / plant.hose_m3_pa
    y[P_T] = (
        plant.precharge_return_pa * (plant.accumulator_return_m3 / y[G_T]) ** plant.accumulator_n
    )


@inlined
def step_valve(
    plant: Record, x_f: float, v_f: float, x_s: float, command: float, h: float
) -> tuple[float, float, float, float]:
    """(x_f, v_f, x_s) after one step of `h` seconds, and x_s at its middle (cubic Hermite, fourth order)."""
    half = 0.5 * h
    a1, s1 = spool_motion(plant, x_f, v_f, x_s, command)
    v2 = v_f + half * a1
    a2, s2 = spool_motion(plant, x_f + half * v_f, v2, x_s + half * s1, command)
    v3 = v_f + half * a2
    a3, s3 = spool_motion(plant, x_f + half * v2, v3, x_s + half * s2, command)
    v4 = v_f + h * a3
    a4, s4 = spool_motion(plant, x_f + h * v3, v4, x_s + h * s3, command)
    x_end = x_s + h / 6.0 * (s1 + 2.0 * (s2 + s3) + s4)
    f_end = x_f + h / 6.0 * (v_f + 2.0 * (v2 + v3) + v4)
    v_end = v_f + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4)
    middle = 0.5 * (x_s + x_end) + 0.125 * h * (s1 - plant.spool_rate_m_s * f_end)
    return f_end, v_end, x_end, middle


@inlined
def move_valve(
    plant: Record, y: Array, command: float, h: float
) -> tuple[float, float, float, float]:
    """(x_f, v_f) after `h` seconds, and x_s half way and then."""
    x_f, v_f, x_s = y[X_F], y[V_F], y[X_S]
    if abs(x_f) < NEAR_STOP:
        x_f, v_f, x_s, middle = step_valve(plant, x_f, v_f, x_s, command, h)
        return x_f, v_f, middle, x_s
    middle = x_s
    fine = h / (2 * FINER_AT_STOP)
    for i in range(2 * FINER_AT_STOP):
        if i == FINER_AT_STOP:
            middle = x_s
        x_f, v_f, x_s, _ = step_valve(plant, x_f, v_f, x_s, command, fine)
    return x_f, v_f, middle, x_s


@inlined
def finer_ticks(plant: Record, y: Array, dy: Array, duration_s: float) -> int:
    """For how many ticks the friction asks for finer steps: while the piston turns round, and the ring of it."""
    widths = abs(y[V_R] - y[V_B]) * plant.coulomb_s_m
    change = abs(dy[V_R] - dy[V_B]) * duration_s * plant.coulomb_s_m
    if widths > TURN + change or change < 0.25:
        return 0
    return RING_TICKS if change > FAST_TURN else 1


@kernel
def advance(
    plant: Record, y: Array, u: Array, work: Record, duration_s: float, substeps: int
) -> None:
    """Carry the state `y` over `duration_s`, in at least `substeps` steps."""
    k1, k2, k3, k4, z, q = work.k1, work.k2, work.k3, work.k4, work.z, work.q
    work.finer_ticks = max(work.finer_ticks - 1, finer_ticks(plant, y, k4, duration_s))
    if work.finer_ticks > 0:
        substeps *= FINER_AT_TURN
    h = duration_s / substeps
    for _ in range(substeps):
        x_f, v_f, x_half, x_end = move_valve(plant, y, u[U_VALVE], h)

        rig_derivatives(plant, y, y[X_S], u, q, k1)
        for i in range(REST, STATES):
            z[i] = y[i] + 0.5 * h * k1[i]
        rig_derivatives(plant, z, x_half, u, q, k2)
        for i in range(REST, STATES):
            z[i] = y[i] + 0.5 * h * k2[i]
        rig_derivatives(plant, z, x_half, u, q, k3)
        for i in range(REST, STATES):
            z[i] = y[i] + h * k3[i]
        rig_derivatives(plant, z, x_end, u, q, k4)
        for i in range(REST, STATES):
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
        y[X_F], y[V_F], y[X_S] = x_f, v_f, x_end
    settle_pressures(plant, y)
