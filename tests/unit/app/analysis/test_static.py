"""The static characteristic against eqs (1) to (3) solved by a root finder, and against the sheet."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from app.analysis.static import (
    bypass_flow,
    force_gain,
    load_pressure,
    static_command,
    static_force,
)
from rtcore.rig.parameters import load_rig, rig_from

RIG = load_rig()
K_SV = 0.62 * 0.023 * 0.8e-3 * math.sqrt(1 / 833.0)
K_O = 0.662 * math.pi / 4 * 0.85e-3**2 * math.sqrt(2 / 833.0)
AVAILABLE_PA = 21e6 - 0.3e6
AREA_M2 = 2.592e-3
commands = st.floats(1e-3, 1.0) | st.floats(-1.0, -1e-3)


def solved(command: float) -> float:
    """Δp at which Q_A = Q_o, by bisection on the two laws of the paper."""
    side = math.copysign(1.0, command)

    def surplus(drop: float) -> float:
        valve = K_SV * command * math.sqrt(AVAILABLE_PA - drop * side)
        return valve - K_O * math.copysign(math.sqrt(abs(drop)), drop)

    low, high = sorted((0.0, side * AVAILABLE_PA))
    return float(brentq(surplus, low, high, xtol=1e-6))


@given(commands)
def test_the_load_pressure_solves_the_papers_equations(command: float) -> None:
    assert load_pressure(RIG, np.array(command)) == pytest.approx(solved(command), rel=1e-6)


@given(commands)
def test_flow_and_force_follow_from_the_load_pressure(command: float) -> None:
    drop = solved(command)
    assert static_force(RIG, np.array(command)) == pytest.approx(AREA_M2 * drop, rel=1e-6)
    flow = K_O * math.copysign(math.sqrt(abs(drop)), drop)
    assert bypass_flow(RIG, np.array(command)) == pytest.approx(flow, rel=1e-6)


@given(st.floats(0.01, 0.99) | st.floats(-0.99, -0.01))
def test_the_force_gain_is_the_slope_of_the_force(command: float) -> None:
    step = 1e-5
    ends = static_force(RIG, np.array([command - step, command + step]))
    slope = (ends[1] - ends[0]) / (2 * step)
    assert force_gain(RIG, np.array(command)) == pytest.approx(slope, rel=1e-4)


@given(commands)
def test_the_command_that_holds_a_force_gives_it(command: float) -> None:
    force_n = float(static_force(RIG, np.array(command)))
    assert static_command(RIG, force_n) == pytest.approx(command, rel=1e-6)


@pytest.mark.parametrize("force_n", [53_600.0, -60_000.0, math.nan])
def test_what_is_beyond_the_authority_has_no_command(force_n: float) -> None:
    assert math.isnan(static_command(RIG, force_n))


def test_the_authority_is_that_of_the_sheet() -> None:
    assert static_force(RIG, np.array([-1.0, 0.0, 1.0])) == pytest.approx(
        [-53.5e3, 0.0, 53.5e3], rel=1e-3
    )


def test_a_larger_orifice_takes_authority_and_force_gain() -> None:
    """Figure 5 of the paper: with K_o the diagram becomes flatter."""
    wide = rig_from({"load_actuator": {"bypass_diameter_m": 1.5e-3}})
    small = np.array(0.02)
    assert static_force(wide, np.array(1.0)) < static_force(RIG, np.array(1.0))
    assert force_gain(wide, small) < force_gain(RIG, small)
    assert bypass_flow(wide, np.array(1.0)) > bypass_flow(RIG, np.array(1.0))
