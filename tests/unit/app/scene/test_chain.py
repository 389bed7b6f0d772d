"""Where the parts of the chain are drawn, against the equations of motion and a system of springs."""

import numpy as np
import pytest

from app.scene.chain import Chain, shifts
from rtcore.rig.constants import plant_constants
from rtcore.rig.derivatives import derivatives
from rtcore.rig.integrate import settle_gas
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import (
    FLOWS,
    INPUTS,
    P_1,
    P_2,
    P_S,
    P_T,
    STATES,
    V_1,
    V_2,
    V_B,
    V_R,
    X_1,
    X_2,
    X_B,
    X_R,
    X_T,
)

RIG = load_rig()
CHAIN = Chain.of(RIG)
MOMENTS = [(50e3, 0.0), (-20e3, 0.012), (0.0, -0.03), (1.0, 0.0)]


@pytest.mark.parametrize(("force_n", "displacement_m"), MOMENTS)
def test_the_chain_is_where_its_springs_hold_it(force_n: float, displacement_m: float) -> None:
    s = RIG.structure
    k_pl, k_lc, k_2, k_tra = s.k_pl, s.k_lc, s.k_2, RIG.unit.k_tra
    stiffness = np.array(  # body, rod, mass 1, mass 2
        [
            [k_pl, 0.0, 0.0, 0.0],
            [0.0, k_lc, -k_lc, 0.0],
            [0.0, -k_lc, k_lc + k_2, -k_2],
            [0.0, 0.0, -k_2, k_2 + k_tra],
        ]
    )
    load = np.array([-force_n, force_n, 0.0, k_tra * displacement_m])
    found = shifts(CHAIN, force_n, displacement_m)
    assert found[:4] == pytest.approx(np.linalg.solve(stiffness, load), rel=1e-9, abs=1e-15)
    assert found.unit_m == displacement_m


@pytest.mark.parametrize(("force_n", "displacement_m"), MOMENTS)
def test_the_plant_at_rest_there_accelerates_nothing(force_n: float, displacement_m: float) -> None:
    plant, y = plant_constants(RIG), np.zeros(STATES)
    y[P_S], y[P_T] = RIG.supply.high_pa, RIG.supply.tank_pa
    middle_pa, drop_pa = 0.5 * (y[P_S] + y[P_T]), force_n / RIG.load_actuator.area_m2
    y[P_1], y[P_2] = middle_pa + 0.5 * drop_pa, middle_pa - 0.5 * drop_pa
    settle_gas(plant, y)
    y[[X_B, X_R, X_1, X_2, X_T]] = shifts(CHAIN, force_n, displacement_m)
    dy = np.zeros(STATES)
    derivatives(plant, y, np.zeros(INPUTS), np.zeros(FLOWS), dy)
    assert dy[[V_B, V_R, V_1, V_2]] == pytest.approx(0.0, abs=1e-6)


def test_what_is_enlarged_is_the_deformation_alone() -> None:
    real, drawn = shifts(CHAIN, 10e3, 0.005), shifts(CHAIN, 10e3, 0.005, deformation=40.0)
    assert drawn.unit_m == real.unit_m
    assert drawn.body_m == pytest.approx(40.0 * real.body_m)
    assert drawn.mass_2_m - 0.005 == pytest.approx(40.0 * (real.mass_2_m - 0.005))
    assert drawn.rod_m - drawn.mass_1_m == pytest.approx(40.0 * (real.rod_m - real.mass_1_m))
