"""What the integrator can follow: the fastest rate against the plant's own linearisation, and its limit."""

import numpy as np
import pytest

from rtcore.rig.integrate import FINER_AT_STOP
from rtcore.rig.linear import linearise
from rtcore.rig.parameters import load_rig, rig_from
from rtcore.rig.plant import SUBSTEPS, V_1, V_2, V_B, V_R, X_1, X_2, X_B, X_F, X_R, Y_F
from rtcore.rig.rates import (
    FASTEST_1_S,
    STEPS_AT_STOP,
    fastest_part,
    second_order_rate,
    smallest_chambers,
    structure_rate,
)
from rtcore.virtual import PERIOD_S
from tests.unit.rtcore.rig.plants import cell_force, inputs, plant, pressurised, states


def test_without_oil_the_fastest_rate_is_that_of_the_plants_structure() -> None:
    """Bodies in the order of the state, from the plant's Jacobian, its chambers made soft."""
    soft = {"load_actuator": {"volume_1_m3": 0.1, "volume_2_m3": 0.1, "coulomb_n": 0.0}}
    record = plant(**soft)
    jacobian = linearise(record, pressurised(record), inputs(1)[0]).a
    bodies = [X_B, X_R, X_1, X_2, V_B, V_R, V_1, V_2]
    rates = np.abs(np.linalg.eigvals(jacobian[np.ix_(bodies, bodies)]))
    assert structure_rate(rig_from(soft)) == pytest.approx(np.max(rates), rel=1e-4)


def test_oil_makes_the_rig_stiffer() -> None:
    """Two chambers are a spring of A² β (1/V_1 + 1/V_2) between body and rod."""
    stiff = {"area_m2": 4e-3, "volume_1_m3": 1.21e-4, "volume_2_m3": 1.21e-4, "coulomb_n": 0.0}
    light = {"m_la_kg": 0.6, "k_lc": 1e6, "c_lc": 0.0}
    rig = rig_from({"load_actuator": stiff, "structure": light})
    spring = 4e-3**2 * (1.5e9 + 11 * 21e6) * 2 / 1.21e-4
    alone = np.sqrt(spring * (1 / 0.6 + 1 / 40.0))
    assert structure_rate(rig) == pytest.approx(alone, rel=0.01)


def test_the_limit_is_within_what_runge_kutta_follows() -> None:
    assert FASTEST_1_S * PERIOD_S / SUBSTEPS < 2.78
    assert fastest_part(load_rig())[1] < 0.6 * FASTEST_1_S


def test_a_rig_near_the_limit_does_not_fly_apart() -> None:
    stiff = {"structure": {"c_2": 5e3, "k_2": 2.8e9}}
    assert 0.9 * FASTEST_1_S < structure_rate(rig_from(stiff)) < FASTEST_1_S
    record = plant(**stiff)
    held = inputs(800)
    held[200:, 0] = 0.3
    force = cell_force(record, states(record, pressurised(record), held))
    assert np.max(np.abs(force)) < 60e3
    assert force[-1] == pytest.approx(52e3, rel=0.05)


@pytest.mark.parametrize("zeta", [0.1, 0.7, 1.0, 3.0])
def test_a_second_order_part_moves_at_its_fastest_root(zeta: float) -> None:
    roots = np.roots([1.0, 2 * zeta * 500.0, 500.0**2])
    assert second_order_rate(500.0, zeta) == pytest.approx(np.max(np.abs(roots)))


@pytest.mark.parametrize(
    ("part", "values", "name"),
    [
        ("sensors", {"omega_lc_rad_s": 2e4, "zeta_lc": 0.7}, "load cell's chain"),
        ("sensors", {"omega_lvt_rad_s": 2e4}, "LVT's chain"),
        ("servovalve", {"omega_f_rad_s": 1e4, "zeta_f": 1.5}, "servovalve's flapper"),
        ("servovalve", {"flapper_stop_c": 20.0, "zeta_f": 1.4}, "flapper's stop"),
    ],
)
def test_the_fastest_part_is_named(part: str, values: dict[str, float], name: str) -> None:
    """Each is just fast enough to lead, and is followed all the same."""
    found, rate = fastest_part(rig_from({part: values}))
    assert found == name
    record = plant(**{part: values})
    held = inputs(400)
    held[100:250, 0], held[250:, 0] = 1.0, -1.0  # into both stops of the valve
    driven = states(record, pressurised(record), held)
    assert np.all(np.abs(driven[:, X_F]) < 1.2)
    assert abs(driven[-1, Y_F] - cell_force(record, driven)[-1]) < 100.0
    assert rate < FASTEST_1_S


def test_the_valve_takes_as_many_steps_at_its_stop_as_are_counted_on() -> None:
    assert STEPS_AT_STOP == 2 * FINER_AT_STOP


def test_the_chambers_keep_some_oil_at_the_ends_of_the_stroke() -> None:
    left = 128.68e-6 - 2.592e-3 * 0.03
    assert smallest_chambers(load_rig()) == pytest.approx((left, left))
