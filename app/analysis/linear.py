"""Linear analysis of the force loop (paper section 5): K_1, K_2 and τ, the loop and its margins.

The bypass has no slope of its own at zero, so the rig is linearised for a load of some amplitude: the
describing function of the orifice there, the lands as they are beyond their laps, no friction.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from rtcore.control.response import (
    compensation_response,
    feed_forward_response,
    pid_response,
    shift,
)
from rtcore.rig.constants import bypass_flow_gain, plant_constants, valve_flow_gain
from rtcore.rig.fluid import specific_volume_law
from rtcore.rig.integrate import settle_gas
from rtcore.rig.linear import (
    FORCE,
    FORCE_READ,
    UNIT_VELOCITY,
    VELOCITY_READ,
    Sampled,
    StateSpace,
    linearise,
)
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import INPUTS, P_1, P_2, P_S, P_T, STATES, U_PUMP, U_UNIT, U_VALVE
from rtcore.rig.servovalve import land_flows

ROOT_DESCRIBED = 1.1128  # describing function of the square root: 2/π ∫ sin^(3/2), 0 to π
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


@dataclass(frozen=True)
class Margins:
    """Of the open loop; `worst_sensitivity` is the peak of 1/|1 + L|."""

    crossover_hz: float
    phase_deg: float
    gain_db: float
    worst_sensitivity: float


def valve_conductance(rig: RigParameters) -> float:
    """G_Q/G_P at null (m³/s/Pa): how much the lands' own leakage gives way to the load pressure."""
    plant = plant_constants(rig)
    supply, tank = rig.supply.high_pa, rig.supply.tank_pa
    middle, step = 0.5 * (supply + tank), 1e4

    def into_1(pressure_pa: float) -> float:
        pa, at, _, _ = land_flows(plant, 0.0, supply, pressure_pa, middle, tank)
        return float(pa - at)

    # Half of a load pressure shows in each chamber.
    return 0.5 * (into_1(middle - step) - into_1(middle + step)) / (2.0 * step)


def bypass_conductance(rig: RigParameters, amplitude_n: float) -> float:
    """The bypass (m³/s/Pa) for a load of some amplitude, by its describing function."""
    drop = amplitude_n / rig.load_actuator.area_m2
    return ROOT_DESCRIBED * bypass_flow_gain(rig) / math.sqrt(drop)


def coefficients(rig: RigParameters, amplitude_n: float) -> Coefficients:
    """K_1, K_2 and τ for a load of some amplitude (N)."""
    actuator, supply = rig.load_actuator, rig.supply
    conductance = (
        bypass_conductance(rig, amplitude_n) + valve_conductance(rig) + actuator.leak_m3_s_pa
    )
    middle = 0.5 * (supply.high_pa + supply.tank_pa)
    v, slope = specific_volume_law(plant_constants(rig), middle)
    capacity = -slope / v * 0.5 * (actuator.volume_1_m3 + actuator.volume_2_m3)
    flow_gain = valve_flow_gain(rig) * math.sqrt(supply.high_pa - supply.tank_pa)
    area = actuator.area_m2
    return Coefficients(
        flow_gain * area / conductance,
        area**2 / conductance,
        capacity / (2.0 * conductance),
        conductance,
    )


def linear_rig(rig: RigParameters, amplitude_n: float) -> StateSpace:
    """The rig's state space at rest under full pressure, for a load of some amplitude (N)."""
    plant = plant_constants(rig)
    plant["bypass_r"], plant["bypass_k"] = CLOSED, 0.0
    plant["bypass_linear"] = bypass_conductance(rig, amplitude_n) + valve_conductance(rig)
    for name in ("pa", "at", "pb", "bt"):
        plant[f"underlap_{name}_m"] = 0.0
    plant["clearance_m"], plant["land_overlap"] = NO_CLEARANCE_M, CLOSED
    for name in ("null_m", "land_laminar_m2", "drain_1_m3_s_pa", "drain_2_m3_s_pa", "coulomb_n"):
        plant[name] = 0.0
    y, u = np.zeros(STATES), np.zeros(INPUTS)
    y[P_S] = u[U_PUMP] = rig.supply.high_pa
    y[P_T] = rig.supply.tank_pa
    y[[P_1, P_2]] = 0.5 * (y[P_S] + y[P_T])
    settle_gas(plant, y)
    return linearise(plant, y, u, OPENING_M)


@dataclass(frozen=True)
class ForceLoop:
    """The linear rig under the control law: a GAINS record, the load's frequency where it has one.

    Without `load_hz` the compensation is left out.
    """

    rig: StateSpace
    gains: Any
    period_s: float
    load_hz: float | None = None

    @cached_property
    def _sampled(self) -> Sampled:
        return self.rig.sampled(self.period_s)

    def open_loop(self, frequency_hz: float) -> complex:
        """L = C P - W P_v, with the tick of delay and the hold."""
        z = shift(frequency_hz, self.period_s)
        held = self._sampled.response(frequency_hz)[:, U_VALVE] / z
        loop = pid_response(self.gains, z, self.period_s) * held[FORCE_READ]
        if self.load_hz is not None:
            branch = compensation_response(self.gains, self.load_hz, z, self.period_s)
            loop -= branch * held[VELOCITY_READ]
        return complex(loop)

    def closed_loop(self, frequency_hz: float) -> complex:
        """True force to setpoint."""
        z = shift(frequency_hz, self.period_s)
        held = self._sampled.response(frequency_hz)[FORCE, U_VALVE] / z
        forward = pid_response(self.gains, z, self.period_s)
        forward += feed_forward_response(self.gains, z, self.period_s)
        return complex(forward * held / (1.0 + self.open_loop(frequency_hz)))

    def margins(self, from_hz: float = 5.0, to_hz: float = 400.0, points: int = 1000) -> Margins:
        """Margins of the open loop between two frequencies; NaN where it does not cross."""
        grid = np.geomspace(from_hz, to_hz, points)
        loop = np.array([self.open_loop(f) for f in grid])
        over = np.flatnonzero(np.abs(loop) > 1.0)
        crossover = phase = gain = math.nan
        if len(over) > 0 and over[-1] + 1 < points:
            edges = grid[over[-1]], grid[over[-1] + 1]
            crossover = float(brentq(lambda f: abs(self.open_loop(f)) - 1.0, *edges))
            phase = 180.0 + math.degrees(np.angle(self.open_loop(crossover)))
        turned = np.flatnonzero(np.unwrap(np.angle(loop)) < -math.pi)
        if len(turned) > 0 and turned[0] > 0:
            edges = grid[turned[0] - 1], grid[turned[0]]
            at = brentq(lambda f: self.open_loop(f).imag, *edges)
            gain = -20.0 * math.log10(abs(self.open_loop(float(at))))
        return Margins(crossover, phase, gain, float(1.0 / np.min(np.abs(1.0 + loop))))


def exact_compensation(rig: StateSpace, frequency_hz: float, period_s: float) -> complex:
    """W (s/m) with which a motion of the unit moves the force no more, at one frequency.

    W = -D/(P D_v - D P_v): P and P_v are load cell and LVT to valve command, delay and hold included;
    D and D_v the same to the unit's velocity.
    """
    sampled = rig.sampled(period_s).response(frequency_hz)
    held = sampled[:, U_VALVE] / shift(frequency_hz, period_s)
    moved = rig.response(frequency_hz)[:, U_UNIT]
    d, d_v = moved[[FORCE_READ, VELOCITY_READ]] / moved[UNIT_VELOCITY]
    return complex(-d / (held[FORCE_READ] * d_v - d * held[VELOCITY_READ]))


def frequency_response(
    loop: ForceLoop, frequencies_hz: npt.NDArray[np.float64]
) -> npt.NDArray[np.complex128]:
    """True force to setpoint at (n,) frequencies."""
    return np.array([loop.closed_loop(float(f)) for f in frequencies_hz])
