"""Plants and states for the tests of the rig, by hand and without the app."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.rig.constants import plant_constants
from rtcore.rig.integrate import WORK, advance, settle_gas
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import (
    INPUTS,
    P_1,
    P_2,
    P_S,
    P_T,
    STATES,
    SUBSTEPS,
    U_PUMP,
    V_1,
    V_R,
    X_1,
    X_R,
)

Floats = npt.NDArray[np.float64]
PERIOD_S = 250e-6
PUMP_PA, TANK_PA = 21e6, 0.3e6


def plant(**overrides: Mapping[str, Any]) -> Any:
    """A PLANT record of the shipped rig with some parameters changed, part by part."""
    return plant_constants(rig_from(overrides))


def inputs(ticks: int) -> Floats:
    """(ticks, INPUTS) with the pump on and all else at zero."""
    held = np.zeros((ticks, INPUTS))
    held[:, U_PUMP] = PUMP_PA
    return held


def pressurised(record: Any, load_pa: float = 0.0) -> Floats:
    """(STATES,) under full pressure, with nothing moving and `load_pa` between the chambers."""
    y = np.zeros(STATES)
    y[P_1], y[P_2] = 10.3e6 + 0.5 * load_pa, 10.3e6 - 0.5 * load_pa
    y[P_S], y[P_T] = PUMP_PA, TANK_PA
    settle_gas(record, y)
    return y


def states(record: Any, y: Floats, held: Floats, substeps: int = SUBSTEPS) -> Floats:
    """(n, STATES) after each tick of held inputs (n, INPUTS), by the loop's integrator."""
    work, y = np.zeros(1, WORK)[0], y.copy()
    found = np.empty((len(held), STATES))
    for k, u in enumerate(held):
        advance(record, y, u, work, PERIOD_S, substeps)
        found[k] = y
    return found


def cell_force(record: Any, found: Floats) -> Floats:
    """(n,) true force in the load cell (N) in (n, STATES) states."""
    spring = record["k_lc"] * (found[:, X_R] - found[:, X_1])
    return np.asarray(spring + record["c_lc"] * (found[:, V_R] - found[:, V_1]))
