"""The law as a whole: limits of size and slew, opening and closing, and which gains may run."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.control.law import closed_loop, gains_are_valid, open_loop
from rtcore.program.segments import Branch
from tests.unit.rtcore.control.laws import PERIOD_S, gains, law

T = PERIOD_S
forces = st.floats(-6e4, 6e4)
Pairs = list[tuple[float, float]]
pairs_of_forces = st.lists(st.tuples(forces, forces), min_size=2, max_size=50)


def commands(of: Any, pairs: Pairs, record: Any = None) -> list[float]:
    """Valve commands for (setpoint, force) pairs."""
    record = law(of) if record is None else record
    excluded = int(Branch.EXCLUDED)
    return [closed_loop(of, record, *pair, 0.0, 0.0, excluded, T) for pair in pairs]


@given(pairs_of_forces, st.floats(0.05, 1.0))
def test_the_command_keeps_within_its_limit(pairs: Pairs, limit: float) -> None:
    assert all(abs(v) <= limit for v in commands(gains(valve_limit=limit), pairs))


@given(pairs_of_forces, st.floats(1.0, 1000.0))
def test_the_command_keeps_within_its_slew(pairs: Pairs, slew: float) -> None:
    found = np.array([0.0, *commands(gains(valve_slew_per_s=slew), pairs)])
    assert np.all(np.abs(np.diff(found)) <= slew * T * (1 + 1e-9))
    assert np.all(np.abs(found) <= 1.0)


def test_an_endless_slew_limits_nothing() -> None:
    assert commands(gains(), [(5e4, -5e4)] * 2) == [1.0, 1.0]


def test_a_slew_that_is_reached_winds_nothing_up() -> None:
    """Held by the slew for a second, the integrator has not moved, and the command turns at once."""
    slow = gains(valve_slew_per_s=0.1)
    record = law(slow)
    commands(slow, [(3e4, 0.0)] * 4000, record)
    assert record["pid"]["integral"] == 0.0
    rising = float(record["valve"])
    assert rising == pytest.approx(0.1)
    assert commands(slow, [(0.0, 3e4)], record)[-1] < rising


def test_an_open_loop_forgets_and_closes_without_a_bump() -> None:
    of = gains()
    record = law(of)
    commands(of, [(4e3, 0.0)] * 500, record)
    open_loop(record, 1e3, 1e3)
    assert record["valve"] == 0.0
    assert commands(of, [(1e3, 1e3)], record) == [0.0]


@pytest.mark.parametrize(
    "wrong",
    [
        {"k_p": math.nan},
        {"k_i": math.inf},
        {"k_d": 1e7},
        {"ff_a": -math.inf},
        {"omega_d_rad_s": 0.0},
        {"lead_zero_rad_s": -1.0},
        {"lead_pole_rad_s": math.nan},
        {"low_pass_rad_s": 0.0},
        {"low_pass_rad_s": 2 * math.pi * 2000.0, "low_pass_order": 2},
        {"low_pass_order": 0},
        {"low_pass_order": 3},
        {"low_pass_damping": 0.0},
        {"notch_damping": 10.0},
        {"valve_limit": 0.0},
        {"valve_limit": 1.1},
        {"valve_slew_per_s": 0.0},
        {"valve_slew_per_s": math.nan},
        {"fade_s": 0.0},
        {"fade_s": math.nan},
    ],
    ids=str,
)
def test_gains_that_mean_nothing_are_refused(wrong: dict[str, float]) -> None:
    assert not gains_are_valid(gains(**wrong), T)


@pytest.mark.parametrize(
    "right",
    [
        {},
        {"valve_slew_per_s": math.inf},
        {"low_pass_order": 2, "low_pass_rad_s": 2 * math.pi * 1999.0},
        {"k_p": 0.0, "k_i": 0.0, "k_d": 0.0, "k_ff": 0.0, "ff_v": -50.0},
    ],
    ids=str,
)
def test_gains_that_mean_something_are_taken(right: dict[str, float]) -> None:
    assert gains_are_valid(gains(**right), T)
