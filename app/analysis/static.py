"""Static characteristic of the force control (paper section 3, figure 5): eqs (1) to (3), solved."""

import math

import numpy as np
import numpy.typing as npt

from rtcore.rig.constants import bypass_flow_gain, valve_flow_gain
from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]
ROUNDING = 1e-9


def load_pressure(rig: RigParameters, command: Floats, pressure_pa: float | None = None) -> Floats:
    """Δp between the chambers (Pa) at valve commands -1…+1, the rod end fixed and nothing moving.

    Δp = (p_s - p_t) K_sv² x²/(K_o² + K_sv² x²) with the sign of x. `pressure_pa` is p_s - p_t at the
    valve, by default from pump to tank.
    """
    available = rig.supply.high_pa - rig.supply.tank_pa if pressure_pa is None else pressure_pa
    valve = (valve_flow_gain(rig) * np.asarray(command, np.float64)) ** 2
    share = valve / (bypass_flow_gain(rig) ** 2 + valve)
    return np.asarray(np.sign(command) * available * share)


def static_force(rig: RigParameters, command: Floats, pressure_pa: float | None = None) -> Floats:
    """Force (N) at valve commands -1…+1."""
    return rig.load_actuator.area_m2 * load_pressure(rig, command, pressure_pa)


def bypass_flow(rig: RigParameters, command: Floats, pressure_pa: float | None = None) -> Floats:
    """Flow through the bypass (m³/s), which is that through the valve, at valve commands -1…+1."""
    drop = load_pressure(rig, command, pressure_pa)
    return np.asarray(bypass_flow_gain(rig) * np.sign(drop) * np.sqrt(np.abs(drop)))


def force_gain(rig: RigParameters, command: Floats, pressure_pa: float | None = None) -> Floats:
    """Derivative of the force by the valve command (N), at valve commands -1…+1."""
    available = rig.supply.high_pa - rig.supply.tank_pa if pressure_pa is None else pressure_pa
    ratio = (valve_flow_gain(rig) / bypass_flow_gain(rig)) ** 2
    x = np.abs(np.asarray(command, np.float64))
    return rig.load_actuator.area_m2 * available * 2.0 * ratio * x / (1.0 + ratio * x**2) ** 2


def static_command(rig: RigParameters, force_n: float, pressure_pa: float | None = None) -> float:
    """Valve command that holds a force (N); NaN beyond the rig's authority."""
    available = rig.supply.high_pa - rig.supply.tank_pa if pressure_pa is None else pressure_pa
    share = abs(force_n) / (rig.load_actuator.area_m2 * available)
    if not share < 1.0:
        return math.nan
    ratio = bypass_flow_gain(rig) / valve_flow_gain(rig)
    command = ratio * math.sqrt(share / (1.0 - share))
    return math.copysign(min(command, 1.0), force_n) if command <= 1.0 + ROUNDING else math.nan
