"""Linear analysis of the rig (paper section 5): K_1, K_2 and τ, and its state space for a load.

The bypass has no slope of its own at zero, so the rig is linearised for a load of some amplitude: the
describing function of the orifice there, the lands as they are beyond their laps, no friction.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.analysis.static import static_command
from rtcore.rig.constants import bypass_flow_gain, plant_constants, valve_flow_gain
from rtcore.rig.fluid import specific_volume_law
from rtcore.rig.integrate import settle_gas
from rtcore.rig.linear import StateSpace, linearise
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import INPUTS, P_1, P_2, P_S, P_T, STATES, U_PUMP, U_VALVE, X_S
from rtcore.rig.servovalve import land_flows

ROOT_DESCRIBED = 1.1128  # describing function of the square root: 2/π ∫ sin^(3/2), 0 to π
DESCRIBED_POINTS = 4096  # of a cycle, where it has a mean
OPENING_M = 4e-5  # over which the lands' gain is taken, 5 % of the stroke
CLOSED = 1e30  # laminar resistance of what lets nothing through
NO_CLEARANCE_M = 1e-7


@dataclass(frozen=True)
class Coefficients:
    """K_1 (N), K_2 (N s/m), τ (s) of eqs (6) to (8), and the conductance that they share."""

    k_1_n: float
    k_2_n_s_m: float
    tau_s: float
    conductance_m3_s_pa: float


def valve_conductance(rig: RigParameters, mean_n: float = 0.0) -> float:
    """G_Q/G_P (m³/s/Pa) where the valve holds a force: how much its flow gives way to the load pressure."""
    return _conductance(rig, plant_constants(rig), mean_n)


def _conductance(rig: RigParameters, plant: Any, mean_n: float) -> float:
    supply, tank = rig.supply.high_pa, rig.supply.tank_pa
    drop, step = mean_n / rig.load_actuator.area_m2, 1e4
    spool_m = static_command(rig, mean_n) * rig.servovalve.spool_stroke_m
    in_1, in_2 = 0.5 * (supply + tank + drop), 0.5 * (supply + tank - drop)

    def into_1(pressure_pa: float) -> float:
        pa, at, _, _ = land_flows(plant, spool_m, supply, pressure_pa, in_2, tank)
        return float(pa - at)

    # Half of a load pressure shows in each chamber.
    return 0.5 * (into_1(in_1 - step) - into_1(in_1 + step)) / (2.0 * step)


def bypass_conductance(rig: RigParameters, amplitude_n: float, mean_n: float = 0.0) -> float:
    """The bypass (m³/s/Pa) for a load of some amplitude and mean, by its describing function."""
    area = rig.load_actuator.area_m2
    drop, mean = amplitude_n / area, mean_n / area
    if mean == 0.0:
        return ROOT_DESCRIBED * bypass_flow_gain(rig) / math.sqrt(drop)
    theta = (np.arange(DESCRIBED_POINTS) + 0.5) * (2.0 * math.pi / DESCRIBED_POINTS)
    pressure = mean + drop * np.sin(theta)
    flow = np.sign(pressure) * np.sqrt(np.abs(pressure))
    return float(2.0 * bypass_flow_gain(rig) * np.mean(flow * np.sin(theta)) / drop)


def coefficients(rig: RigParameters, amplitude_n: float, mean_n: float = 0.0) -> Coefficients:
    """K_1, K_2 and τ for a load of some amplitude (N) about a mean (N)."""
    actuator, supply = rig.load_actuator, rig.supply
    area = actuator.area_m2
    conductance = (
        bypass_conductance(rig, amplitude_n, mean_n)
        + valve_conductance(rig, mean_n)
        + actuator.leak_m3_s_pa
    )
    middle = 0.5 * (supply.high_pa + supply.tank_pa)
    v, slope = specific_volume_law(plant_constants(rig), middle)
    capacity = -slope / v * 0.5 * (actuator.volume_1_m3 + actuator.volume_2_m3)
    available = supply.high_pa - supply.tank_pa - abs(mean_n) / area
    flow_gain = valve_flow_gain(rig) * math.sqrt(available)
    return Coefficients(
        flow_gain * area / conductance,
        area**2 / conductance,
        capacity / (2.0 * conductance),
        conductance,
    )


def linear_rig(rig: RigParameters, amplitude_n: float, mean_n: float = 0.0) -> StateSpace:
    """The rig's state space under full pressure, for a load of some amplitude (N) about a mean (N).

    Raises ValueError where the rig cannot hold the mean.
    """
    command, drop = static_command(rig, mean_n), mean_n / rig.load_actuator.area_m2
    if math.isnan(command):
        raise ValueError(f"this rig cannot hold {mean_n:,.0f} N")
    plant = plant_constants(rig)
    leaving_m3_s_pa = valve_conductance(rig, mean_n)
    plant["bypass_r"], plant["bypass_k"] = CLOSED, 0.0
    for name in ("pa", "at", "pb", "bt"):
        plant[f"underlap_{name}_m"] = 0.0
    plant["clearance_m"], plant["land_overlap"] = NO_CLEARANCE_M, CLOSED
    for name in ("null_m", "land_laminar_m2", "drain_1_m3_s_pa", "drain_2_m3_s_pa", "coulomb_n"):
        plant[name] = 0.0
    # Lands without laps give way to pressure themselves where they are open: the rest goes by the bypass.
    leaving_m3_s_pa -= _conductance(rig, plant, mean_n)
    plant["bypass_linear"] = bypass_conductance(rig, amplitude_n, mean_n) + max(leaving_m3_s_pa, 0)
    y, u = np.zeros(STATES), np.zeros(INPUTS)
    y[P_S] = u[U_PUMP] = rig.supply.high_pa
    y[P_T] = rig.supply.tank_pa
    y[[P_1, P_2]] = 0.5 * (y[P_S] + y[P_T])
    y[[P_1, P_2]] += 0.5 * drop, -0.5 * drop
    y[X_S] = command * rig.servovalve.spool_stroke_m
    u[U_VALVE] = command
    settle_gas(plant, y)
    return linearise(plant, y, u, OPENING_M)
