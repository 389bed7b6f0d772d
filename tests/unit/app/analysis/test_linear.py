"""Linear analysis against the rig's sheet (sections 3 and 4), and against closed forms."""

import math
from functools import cache

import numpy as np
import pytest

from app.analysis.force_loop import ForceLoop, exact_compensation
from app.analysis.linear import bypass_conductance, coefficients, linear_rig, valve_conductance
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from rtcore.control.response import quadrature_gains, shift
from rtcore.rig.linear import FORCE, FORCE_READ, VELOCITY_READ, StateSpace
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import U_UNIT, U_VALVE

RIG = load_rig()
PERIOD_S = 250e-6
GAINS = to_record(ControllerSettings())


@cache
def linear(amplitude_n: float) -> StateSpace:
    return linear_rig(RIG, amplitude_n)


# amplitude (kN), K_1 (kN), K_2 (kN s/m), τ (ms), crossover (Hz), phase (°) and gain (dB) margin, M_s
SHEET = [
    (1, 138, 199, 1.20, 43.7, 62, 10.1, 1.56),
    (2, 193, 279, 1.68, 45.6, 57, 10.0, 1.58),
    (5, 300, 432, 2.60, 46.9, 51, 9.9, 1.59),
    (10, 416, 599, 3.61, 47.4, 48, 9.8, 1.60),
]


@pytest.mark.parametrize("row", SHEET, ids=lambda row: f"{row[0]} kN")
def test_the_coefficients_are_those_of_the_sheet(row: tuple[float, ...]) -> None:
    found = coefficients(RIG, row[0] * 1e3)
    assert found.k_1_n == pytest.approx(row[1] * 1e3, rel=4e-3)
    assert found.k_2_n_s_m == pytest.approx(row[2] * 1e3, rel=4e-3)
    assert found.tau_s == pytest.approx(row[3] * 1e-3, rel=5e-3)


@pytest.mark.parametrize("row", SHEET, ids=lambda row: f"{row[0]} kN")
def test_the_margins_are_those_of_the_sheet(row: tuple[float, ...]) -> None:
    found = ForceLoop(linear(row[0] * 1e3), GAINS, PERIOD_S).margins()
    assert found.crossover_hz == pytest.approx(row[4], abs=0.15)
    assert found.phase_deg == pytest.approx(row[5], abs=0.6)
    assert found.gain_db == pytest.approx(row[6], abs=0.06)
    assert found.worst_sensitivity == pytest.approx(row[7], abs=0.01)


def test_the_static_gain_of_the_linear_rig_is_k_1() -> None:
    gain = linear(2e3).response(1e-3)[FORCE, U_VALVE]
    assert gain.real == pytest.approx(coefficients(RIG, 2e3).k_1_n, rel=2e-3)


def test_the_structure_slows_the_loop_as_the_sheet_says() -> None:
    """C_e = C/2 + A² Y_0 is 5.6 times C/2: the corner of force per valve is that much below 1/τ."""
    conductance = coefficients(RIG, 2e3).conductance_m3_s_pa
    corner_hz = conductance / 2.28e-13 / (2 * math.pi)
    response = linear(2e3).response(corner_hz)[FORCE, U_VALVE]
    assert abs(response) / coefficients(RIG, 2e3).k_1_n == pytest.approx(0.5**0.5, rel=0.02)


@pytest.mark.parametrize(
    ("compensator", "tuned_hz", "ff_v", "ff_a"),
    [("COMP4", 4.0, 1.9607, 0.010862), ("COMP8", 8.0, 4.2148, 0.0097056)],
)
def test_the_shipped_compensators_are_the_exact_tuning(
    compensator: str, tuned_hz: float, ff_v: float, ff_a: float
) -> None:
    """W = -D/(P D_v - D P_v) at 3 kN, under a load at 50 Hz, to all digits of the sheet."""
    gains = to_record(ControllerSettings.model_validate({"compensator": compensator}))
    wanted = exact_compensation(linear(3e3), tuned_hz, PERIOD_S)
    found = quadrature_gains(gains, wanted, 50.0, shift(tuned_hz, PERIOD_S), PERIOD_S)
    assert found == pytest.approx((ff_v, ff_a), rel=5e-5)
    assert (gains["ff_v"], gains["ff_a"]) == (ff_v, ff_a)


def test_exact_tuning_takes_the_motion_out_of_the_force() -> None:
    """Force and LVT under a moving unit, the valve fed W times the LVT: nothing is left in the force."""
    for frequency_hz in (2.0, 4.0, 15.0):
        w = exact_compensation(linear(2e3), frequency_hz, PERIOD_S)
        moved = linear(2e3).response(frequency_hz)[:, U_UNIT]
        held = linear(2e3).sampled(PERIOD_S).response(frequency_hz)[:, U_VALVE]
        held = held / shift(frequency_hz, PERIOD_S)
        # y_V = d_v + P_v W y_V, y_F = d + P W y_V
        velocity = moved[VELOCITY_READ] / (1.0 - held[VELOCITY_READ] * w)
        force = moved[FORCE_READ] + held[FORCE_READ] * w * velocity
        assert abs(force) < 1e-9 * abs(moved[FORCE_READ])


def test_the_branch_feeds_back_positively_through_the_lvt() -> None:
    plain = ForceLoop(linear(2e3), GAINS, PERIOD_S)
    with_branch = ForceLoop(linear(2e3), GAINS, PERIOD_S, load_hz=50.0)
    assert plain.open_loop(30.0) != with_branch.open_loop(30.0)
    assert with_branch.margins().phase_deg < plain.margins().phase_deg
    # At the load's own frequency the notch takes the branch out.
    assert with_branch.open_loop(50.0) == pytest.approx(plain.open_loop(50.0), rel=1e-6)


def test_an_integrator_leaves_no_error_at_low_frequency() -> None:
    loop = ForceLoop(linear(5e3), GAINS, PERIOD_S)
    found = loop.closed_loops(np.array([0.01, 0.1]))
    assert np.abs(found) == pytest.approx(1.0, abs=1e-3)


def test_the_conductances_are_the_slopes_that_they_stand_for() -> None:
    """The describing function of a root by its Fourier integral; the lands' leakage by hand."""
    amplitude_pa = 2e3 / 2.592e-3
    angle = np.linspace(0.0, np.pi, 20_001)
    k_o = 0.662 * math.pi / 4 * 0.85e-3**2 * math.sqrt(2 / 833.0)
    flow = k_o * np.sqrt(amplitude_pa * np.sin(angle))
    described = 2 / np.pi * np.trapezoid(flow * np.sin(angle), angle) / amplitude_pa
    assert bypass_conductance(RIG, 2e3) == pytest.approx(described, rel=1e-4)

    h, drop = math.hypot(4e-6, 4e-6), 10.35e6
    ideal = 0.62 * 0.023 * h * math.sqrt(2 * drop / 833.0)
    reynolds = 2 * ideal / (0.023 * 14.3e-6)
    flow_at_null = ideal * math.sqrt(reynolds / (reynolds + 15))
    # Two lands at each chamber, half of the load pressure each, and dQ/dΔp near Q/(2Δp).
    assert valve_conductance(RIG) == pytest.approx(flow_at_null / (2 * drop), rel=0.1)


def test_where_nothing_crosses_there_is_no_margin() -> None:
    quiet = GAINS.copy()
    for name in ("k_p", "k_i", "k_d"):
        quiet[name] *= 1e-6
    found = ForceLoop(linear(2e3), quiet, PERIOD_S).margins()
    assert math.isnan(found.crossover_hz)
    assert math.isnan(found.phase_deg)
    assert found.gain_db > 100.0
