"""The static characteristic of the non-linear plant against eqs (1) to (3) of the paper."""

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from app.analysis.static import load_pressure
from bench.recorded import Floats, quiet_rig, ready_rig
from bench.report import Figure
from rtcore.rig.constants import bypass_flow_gain, plant_constants, valve_flow_gain
from rtcore.rig.derivatives import flows
from rtcore.rig.linear import settle
from rtcore.rig.parameters import LEAST_REYNOLDS, RigParameters
from rtcore.rig.plant import FLOWS, P_1, P_2, P_S, P_T, Q_AT, Q_BYPASS, Q_PA, U_VALVE, X_S

# Line-to-line lands of the least clearance, turbulent throughout, and no way out but bypass and valve.
NO_LAPS = {f"underlap_{land}_m": 0.0 for land in ("pa", "at", "pb", "bt")}
IDEAL = {
    "servovalve": {"clearance_m": 1e-7, "transition_reynolds": LEAST_REYNOLDS, **NO_LAPS},
    "load_actuator": {
        "bypass_transition_reynolds": LEAST_REYNOLDS,
        "leak_m3_s_pa": 0.0,
        "drain_1_m3_s_pa": 0.0,
        "drain_2_m3_s_pa": 0.0,
    },
}
COMMANDS = (0.01, 0.02, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0)
Start = tuple[Floats, Floats]
SMALLEST_WITH_LANDS = 0.05


class Static(NamedTuple):
    """Relative errors of the load pressure, of the valve's flow and of the bypass's."""

    drop: float
    valve: float
    bypass: float


def full_pressure(rig: RigParameters) -> Start:
    """A state of a rig under full pressure, and the inputs held in it."""
    world = ready_rig(rig).io.world
    return world["y"].copy(), world["u"].copy()


def at_rest(rig: RigParameters, start: Start, command: float) -> Static:
    """What is left of eqs (1) to (3), relative to them, once a held command has come to rest."""
    plant, inputs = plant_constants(rig), start[1].copy()
    inputs[U_VALVE] = command
    y = settle(plant, start[0], inputs)
    q = np.zeros(FLOWS)
    flows(plant, y, y[X_S], inputs, q)
    available, drop = y[P_S] - y[P_T], y[P_1] - y[P_2]
    side = math.copysign(1.0, command)
    valve_law = valve_flow_gain(rig) * command * math.sqrt(available - drop * side)
    bypass_law = bypass_flow_gain(rig) * side * math.sqrt(abs(drop))
    valve = q[Q_PA] - q[Q_AT]
    law = float(load_pressure(rig, np.array(command), available))
    return Static(drop / law - 1.0, valve / valve_law - 1.0, q[Q_BYPASS] / bypass_law - 1.0)


def both_signs(commands: Iterable[float]) -> list[float]:
    """Each command and its opposite."""
    return [side * x for x in commands for side in (1.0, -1.0)]


def figures() -> Iterator[Figure]:
    """With leakage and laminar terms removed, and with the lands as they are."""
    start = full_pressure(quiet_rig())
    ideal = [at_rest(quiet_rig(IDEAL), start, x) for x in both_signs(COMMANDS)]
    worst = 100.0 * max(abs(share) for found in ideal for share in found)
    yield Figure(
        "static_ideal_percent",
        "eqs (1) to (3), leakage and laminar terms removed",
        worst,
        "%",
        at_most=0.1,
        note=f"{worst:.5f} % at worst of Δp and both flows, from ±{COMMANDS[0]:g} to ±1",
    )
    with_lands = both_signs(x for x in COMMANDS if x >= SMALLEST_WITH_LANDS)
    real = [at_rest(quiet_rig(), start, x).drop for x in with_lands]
    worst = 100.0 * max(abs(share) for share in real)
    yield Figure(
        "static_real_percent",
        "Δp with real lands, from 5 % command",
        worst,
        "%",
        at_most=1.2,
        note=f"{worst:.3f} % at worst",
    )
