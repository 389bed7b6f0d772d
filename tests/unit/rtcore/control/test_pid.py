"""PID: its transfer function by scipy, its clamping by a reference in plain Python."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from rtcore.control.pid import PID, pid_step, reset_pid
from tests.unit.rtcore.control.laws import PERIOD_S, gains

T = PERIOD_S
GAINS = gains()
FREE = (-math.inf, math.inf)
Floats = npt.NDArray[np.float64]
forces = st.floats(-5e4, 5e4)


def run(
    setpoints: Floats, measured: Floats, limits: tuple[float, float] = FREE
) -> tuple[Floats, Floats]:
    """(valve commands, integrals), each (n,)."""
    pid = np.zeros(1, PID)[0]
    valve, integral = np.empty(len(measured)), np.empty(len(measured))
    for k, (setpoint, force) in enumerate(zip(setpoints, measured, strict=True)):
        valve[k] = pid_step(GAINS, pid, setpoint, force, 0.0, *limits, T)
        integral[k] = pid["integral"]
    return valve, integral


def test_away_from_saturation_it_is_three_filters_and_a_feed_forward() -> None:
    rng = np.random.default_rng(1)
    setpoints, measured = rng.normal(0, 2e3, (2, 500))
    error = setpoints - measured
    a = math.exp(-2 * math.pi * 190 * T)
    wanted = 1.19e-5 * error
    wanted += signal.lfilter([0.00438 * T], [1, -1], error)
    wanted += 3.39e-8 * signal.lfilter([(1 - a) / T, -(1 - a) / T], [1, -a], error)
    wanted += 6e-9 * np.diff(setpoints, prepend=0.0) / T
    assert run(setpoints, measured)[0] == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@dataclass
class Reference:
    """Paper eqs (9) and (10) with clamping, written out once more."""

    integral: float = 0.0
    slope: float = 0.0
    error: float = 0.0
    setpoint: float = 0.0

    def step(
        self, setpoint: float, force: float, extra: float, limits: tuple[float, float]
    ) -> float:
        error = setpoint - force
        keep = math.exp(-2 * math.pi * 190 * T)
        self.slope = keep * self.slope + (1 - keep) * (error - self.error) / T
        candidate = self.integral + 0.00438 * error * T
        asked = 1.19e-5 * error + candidate + 3.39e-8 * self.slope
        asked += 6e-9 * (setpoint - self.setpoint) / T + extra
        given = sorted((limits[0], asked, limits[1]))[1]
        if given == asked or (asked - given) * error < 0:
            self.integral = candidate
        self.error, self.setpoint = error, setpoint
        return given


@given(
    st.lists(st.tuples(forces, forces, st.floats(-2, 2)), min_size=1, max_size=60),
    st.floats(-1.0, -0.01),
    st.floats(0.01, 1.0),
)
def test_clamping_is_that_of_the_reference(
    steps: list[tuple[float, float, float]], lowest: float, highest: float
) -> None:
    pid, reference = np.zeros(1, PID)[0], Reference()
    for setpoint, force, extra in steps:
        valve = pid_step(GAINS, pid, setpoint, force, extra, lowest, highest, T)
        assert lowest <= valve <= highest
        wanted = reference.step(setpoint, force, extra, (lowest, highest))
        assert valve == pytest.approx(wanted, rel=1e-9, abs=1e-12)
        assert pid["integral"] == pytest.approx(reference.integral, rel=1e-9, abs=1e-12)


def test_a_saturated_integrator_stands_still_and_lets_go_at_once() -> None:
    """Ten seconds of an error that cannot be met wind nothing up."""
    setpoints = np.concatenate((np.full(40_000, 2e5), np.zeros(40)))
    valve, integral = run(setpoints, np.full(len(setpoints), 1e4), (-1.0, 1.0))
    assert np.all(valve[10:40_000] == 1.0)
    assert np.ptp(integral[10:40_000]) == 0.0
    assert np.all(valve[40_000:] < 0.0)


def test_saturated_by_something_else_it_integrates_out_of_saturation() -> None:
    """The compensation saturates the valve upwards while the error asks for less: the integral follows."""
    pid = np.zeros(1, PID)[0]
    for _ in range(100):
        valve = pid_step(GAINS, pid, 0.0, 5e3, 3.0, -1.0, 1.0, T)
    assert valve == 1.0
    assert pid["integral"] == pytest.approx(-0.00438 * 5e3 * 100 * T)


@given(forces, forces)
def test_the_first_step_after_a_reset_knows_no_jump(setpoint: float, force: float) -> None:
    pid = np.zeros(1, PID)[0]
    reset_pid(pid, setpoint, force)
    valve = pid_step(GAINS, pid, setpoint, force, 0.0, *FREE, T)
    error = setpoint - force
    assert valve == pytest.approx((1.19e-5 + 0.00438 * T) * error, rel=1e-9, abs=1e-15)


def test_more_force_asked_for_opens_the_valve_and_more_force_closes_it() -> None:
    assert run(np.array([1e3]), np.array([0.0]))[0][0] > 0.0
    assert run(np.array([0.0]), np.array([1e3]))[0][0] < 0.0


def test_what_is_no_number_does_not_turn_into_a_command() -> None:
    valve, _ = run(np.array([1e3]), np.array([math.nan]), (-1.0, 1.0))
    assert math.isnan(valve[0])
