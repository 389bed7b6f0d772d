"""The servovalve: small-signal response of the sheet, and its stops."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rtcore.rig.plant import STATES, U_VALVE, V_F, X_F, X_S
from rtcore.rig.servovalve import flapper_stop, spool_motion
from tests.unit.rtcore.rig.plants import inputs, plant, pressurised, states

PLANT = plant()
STROKE_M = 0.8e-3


def small_signal(frequency_hz: float) -> complex:
    """Spool per command of a valve that is only differentiated here, away from its stops."""
    step = 1e-6

    def rates(x_f: float, v_f: float, x_s: float, command: float) -> np.ndarray:
        acceleration, velocity = spool_motion(PLANT, x_f, v_f, x_s, command)
        return np.array([v_f, acceleration, velocity])

    at = np.zeros(4)
    columns = []
    for i, scale in enumerate((1.0, 1e3, STROKE_M, 1.0)):
        moved = at.copy()
        moved[i] = step * scale
        columns.append((rates(*moved) - rates(*-moved)) / (2 * step * scale))
    matrix, by_command = np.stack(columns[:3], 1), columns[3]
    s = 2j * np.pi * frequency_hz
    return complex(np.linalg.solve(s * np.eye(3) - matrix, by_command)[2] / STROKE_M)


def crossing(of: Callable[[float], float]) -> float:
    return float(brentq(of, 100.0, 400.0))


def test_the_valve_loses_3_db_at_187_hz() -> None:
    at_hz = crossing(lambda f: abs(small_signal(f)) - 0.5**0.5)
    assert at_hz == pytest.approx(187.0, abs=0.5)  # half of the power
    assert abs(small_signal(0.1)) == pytest.approx(1.0, abs=1e-6)


def test_the_valve_lags_90_degrees_at_203_hz() -> None:
    at_hz = crossing(lambda f: float(np.angle(small_signal(f), deg=True)) + 90.0)
    assert at_hz == pytest.approx(203.0, abs=0.5)


@given(st.floats(-1.5, 1.5), st.floats(-1e4, 1e4))
def test_a_stop_pushes_back_or_not_at_all(x_f: float, v_f: float) -> None:
    push = flapper_stop(PLANT, x_f, v_f)
    assert push * x_f >= 0.0
    if abs(x_f) <= 1.0:
        assert push == 0.0


def test_a_stop_is_a_spring_with_a_damper_that_comes_in_with_depth() -> None:
    omega, zeta, k, c = 2827.4333882308138, 0.6, 30.0, 4.0
    for depth, ramp in ((0.01, 0.5), (0.04, 1.0)):
        for rate in (100.0, -50.0):
            wanted = max(0.0, omega**2 * k * depth + 2 * zeta * omega * c * rate * ramp)
            assert flapper_stop(PLANT, 1.0 + depth, rate) == pytest.approx(wanted)
            assert flapper_stop(PLANT, -1.0 - depth, -rate) == pytest.approx(-wanted)


def test_the_torque_motor_bends_the_flapper_by_at_most_one_and_a_half_travels() -> None:
    """Whatever the spool is away from its command: K_sp/v_s,max metres to one, limited."""
    omega = 2827.4333882308138
    pushed, still = spool_motion(PLANT, 0.0, 0.0, -STROKE_M, 1.0)
    assert pushed == pytest.approx(1.5 * omega**2)
    assert still == 0.0
    small, _ = spool_motion(PLANT, 0.0, 0.0, 0.1 * STROKE_M, 0.0)
    assert small == pytest.approx(-(omega**2) * 691.1503837897545 / 0.336 * 0.1 * STROKE_M)


def moved(commands: np.ndarray) -> np.ndarray:
    """(n, STATES) under (n,) valve commands."""
    held = inputs(len(commands))
    held[:, U_VALVE] = commands
    return states(PLANT, pressurised(PLANT), held)


def test_a_full_step_slews_at_the_flappers_end_of_travel() -> None:
    """420 strokes a second: the spool needs 2/420 s from end to end once the flapper is at its stop."""
    found = moved(np.concatenate((np.full(80, -1.0), np.full(80, 1.0))))
    rate = np.diff(found[80:, X_S]) / 250e-6
    assert found[79, X_S] == pytest.approx(-STROKE_M, rel=1e-3)
    assert np.max(rate) == pytest.approx(0.336, rel=0.05)  # the stop gives way by that much
    assert found[-1, X_S] == pytest.approx(STROKE_M, rel=1e-3)
    assert np.max(np.abs(found[:, X_F])) < 1.1


def test_the_stops_agree_with_scipy() -> None:
    """A jump from end to end and back, by an integrator that knows nothing of ticks."""
    commands = np.concatenate((np.full(40, 1.0), np.full(40, -1.0)))
    y = np.zeros(3)
    spool = np.empty(len(commands))
    for k, command in enumerate(commands):

        def rates(t: float, v: np.ndarray, command: float = command) -> list[float]:
            return [v[1], *spool_motion(PLANT, v[0], v[1], v[2], command)]

        y = solve_ivp(rates, (0.0, 250e-6), y, rtol=1e-9, atol=[1e-9, 1e-6, 1e-13]).y[:, -1]
        spool[k] = y[2]
    assert np.max(np.abs(moved(commands)[:, X_S] - spool)) < 2e-4 * STROKE_M


def test_the_spool_stays_where_no_command_moves_it() -> None:
    found = moved(np.zeros(200))
    assert not np.any(found[:, [X_F, V_F, X_S]])
    assert found.shape == (200, STATES)
