"""The plant over one tick: classical Runge-Kutta, a fixed number of substeps, inputs held."""

import numpy as np

from rtcore.compiled import kernel
from rtcore.rig.derivatives import derivatives
from rtcore.rig.plant import FLOWS, G_S, G_T, P_S, P_T, STATES

WORK = np.dtype(
    [("q", "f8", (FLOWS,)), *((k, "f8", (STATES,)) for k in ("k1", "k2", "k3", "k4", "z"))], align=True
)


@kernel
def settle_gas(plant, y):
    """Set the gas volumes to what the polytropic law says at these pressures."""
    y[G_S] = plant.accumulator_supply_m3
    if y[P_S] > plant.precharge_supply_pa:
        y[G_S] *= (plant.precharge_supply_pa / y[P_S]) ** (1.0 / plant.accumulator_n)
    y[G_T] = plant.accumulator_return_m3 * (plant.precharge_return_pa / y[P_T]) ** (1.0 / plant.accumulator_n)


@kernel
def advance(plant, y, u, work, duration_s, substeps):
    """Carry the state `y` over `duration_s` in `substeps` of the classical fourth-order Runge-Kutta method."""
    k1, k2, k3, k4, z, q = work.k1, work.k2, work.k3, work.k4, work.z, work.q
    h = duration_s / substeps
    for _ in range(substeps):
        derivatives(plant, y, u, q, k1)
        for i in range(STATES):
            z[i] = y[i] + 0.5 * h * k1[i]
        derivatives(plant, z, u, q, k2)
        for i in range(STATES):
            z[i] = y[i] + 0.5 * h * k2[i]
        derivatives(plant, z, u, q, k3)
        for i in range(STATES):
            z[i] = y[i] + h * k3[i]
        derivatives(plant, z, u, q, k4)
        for i in range(STATES):
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
    settle_gas(plant, y)
