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

from app.analysis.static import static_command
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
from rtcore.rig.plant import INPUTS, P_1, P_2, P_S, P_T, STATES, U_PUMP, U_UNIT, U_VALVE, X_S
from rtcore.rig.servovalve import land_flows

Floats = npt.NDArray[np.float64]
Complexes = npt.NDArray[np.complex128]

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


@dataclass(frozen=True)
class Margins:
    """Of the open loop; `worst_sensitivity` is the peak of 1/|1 + L|, `turnover_hz` where the gain margin is."""

    crossover_hz: float
    phase_deg: float
    gain_db: float
    worst_sensitivity: float
    turnover_hz: float = math.nan


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
        return complex(self.open_loops(np.array([frequency_hz]))[0])

    def closed_loop(self, frequency_hz: float) -> complex:
        """True force to setpoint."""
        return complex(self.closed_loops(np.array([frequency_hz]))[0])

    def open_loops(self, frequencies_hz: Floats) -> Complexes:
        """L at (n,) frequencies."""
        return self._open(frequencies_hz, self._held(frequencies_hz))

    def closed_loops(self, frequencies_hz: Floats) -> Complexes:
        """True force to setpoint at (n,) frequencies."""
        held, shifts = self._held(frequencies_hz), self._shifts(frequencies_hz)
        forward = np.array(
            [
                pid_response(self.gains, z, self.period_s)
                + feed_forward_response(self.gains, z, self.period_s)
                for z in shifts
            ]
        )
        return np.asarray(forward * held[:, FORCE] / (1.0 + self._open(frequencies_hz, held)))

    def disturbances(self, frequencies_hz: Floats) -> Complexes:
        """What the load cell reads of the velocity of the unit's output (N s/m), at (n,) frequencies.

        (D - W (P_v D - P D_v))/(1 + L), without setpoint.
        """
        held = self._held(frequencies_hz)
        d, d_v = _moved(self.rig, frequencies_hz)
        w = self._compensation(frequencies_hz)
        told = w * (held[:, VELOCITY_READ] * d - held[:, FORCE_READ] * d_v)
        return np.asarray((d - told) / (1.0 + self._open(frequencies_hz, held)))

    def margins(self, from_hz: float = 5.0, to_hz: float = 400.0, points: int = 1000) -> Margins:
        """Margins of the open loop between two frequencies; NaN where it does not cross."""
        grid = np.geomspace(from_hz, to_hz, points)
        loop = self.open_loops(grid)
        over = np.flatnonzero(np.abs(loop) > 1.0)
        crossover = phase = gain = turnover = math.nan
        if len(over) > 0 and over[-1] + 1 < points:
            edges = grid[over[-1]], grid[over[-1] + 1]
            crossover = float(brentq(lambda f: abs(self.open_loop(f)) - 1.0, *edges))
            phase = 180.0 + math.degrees(np.angle(self.open_loop(crossover)))
        turned = np.flatnonzero(np.unwrap(np.angle(loop)) < -math.pi)
        if len(turned) > 0 and turned[0] > 0:
            edges = grid[turned[0] - 1], grid[turned[0]]
            turnover = float(brentq(lambda f: self.open_loop(f).imag, *edges))
            gain = -20.0 * math.log10(abs(self.open_loop(turnover)))
        worst = float(1.0 / np.min(np.abs(1.0 + loop)))
        return Margins(crossover, phase, gain, worst, turnover)

    def _shifts(self, frequencies_hz: Floats) -> Complexes:
        return np.array([shift(f, self.period_s) for f in frequencies_hz])

    def _held(self, frequencies_hz: Floats) -> Complexes:
        """(n, outputs) to the valve command, the tick of delay and the hold included."""
        shifts = self._shifts(frequencies_hz)
        found = responses(self._sampled.a, self._sampled.b, self._sampled.c, shifts)
        return np.asarray(found[:, :, U_VALVE] / shifts[:, None])

    def _compensation(self, frequencies_hz: Floats) -> Complexes:
        if self.load_hz is None:
            return np.zeros(len(frequencies_hz), np.complex128)
        at = self._shifts(frequencies_hz)
        return np.array(
            [compensation_response(self.gains, self.load_hz, z, self.period_s) for z in at]
        )

    def _open(self, frequencies_hz: Floats, held: Complexes) -> Complexes:
        at = self._shifts(frequencies_hz)
        forward = np.array([pid_response(self.gains, z, self.period_s) for z in at])
        back = self._compensation(frequencies_hz) * held[:, VELOCITY_READ]
        return np.asarray(forward * held[:, FORCE_READ] - back)


def responses(a: Floats, b: Floats, c: Floats, at: Complexes) -> Complexes:
    """(n, outputs, inputs): C (z - A)⁻¹ B at (n,) values of z, or of s."""
    inverse = np.linalg.solve(at[:, None, None] * np.eye(len(a)) - a, b[None].astype(complex))
    return np.asarray(c @ inverse)


def _moved(rig: StateSpace, frequencies_hz: Floats) -> tuple[Complexes, Complexes]:
    """D and D_v: what load cell and LVT read of the velocity of the unit's output, the valve held."""
    found = responses(rig.a, rig.b, rig.c, np.asarray(2j * np.pi * frequencies_hz))[:, :, U_UNIT]
    d, d_v = found[:, FORCE_READ], found[:, VELOCITY_READ]
    return d / found[:, UNIT_VELOCITY], d_v / found[:, UNIT_VELOCITY]


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


def frequency_response(loop: ForceLoop, frequencies_hz: Floats) -> Complexes:
    """True force to setpoint at (n,) frequencies."""
    return loop.closed_loops(frequencies_hz)
