"""Balances of oil, energy and momentum in any motion, and that each goes red on a planted bug."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from bench.balances import Balance, Fault, balance
from rtcore.rig.fluid import specific_volume_law
from rtcore.rig.ledger import contents, head
from rtcore.rig.plant import (
    G_S,
    P_1,
    P_2,
    P_S,
    U_BLEED,
    U_PUMP,
    U_UNIT,
    U_VALVE,
    V_B,
    X_R,
)
from tests.unit.rtcore.rig.plants import PERIOD_S, Floats, inputs, plant, pressurised

PLANT = plant()
LIMIT = 1e-6  # of throughput


def shaken() -> tuple[Floats, Floats]:
    """(state, 600 ticks of inputs): the valve thrown about, the unit moving, from an unloaded rest."""
    held = inputs(600)
    rng = np.random.default_rng(5)
    held[:, U_VALVE] = 0.3 * np.repeat(rng.uniform(-1, 1, 60), 10)
    held[:, U_UNIT] = 2e-3 * np.sin(2 * np.pi * 10 * PERIOD_S * np.arange(600))
    return pressurised(PLANT), held


def slammed() -> tuple[Floats, Floats]:
    """The valve from stop to stop, and the supply bled the while."""
    held = inputs(400)
    held[:200, U_VALVE], held[200:, U_VALVE] = 1.0, -1.0
    held[100:, U_BLEED] = 1.0
    held[100:, U_PUMP] = 0.3e6
    return pressurised(PLANT), held


@pytest.mark.parametrize("motion", [shaken, slammed])
def test_nothing_is_lost_and_nothing_comes_from_nowhere(
    motion: Callable[[], tuple[Floats, Floats]],
) -> None:
    found = balance(PLANT, *motion())
    assert found.oil < LIMIT
    assert found.energy < LIMIT
    assert found.momentum < LIMIT


SEEN_IN = {
    Fault.FLOW_FROM_NOWHERE: {"oil", "energy"},
    Fault.ORIFICE_OFF_ITS_LAW: {"energy"},
    Fault.OIL_TOO_STIFF: {"oil", "energy"},
    Fault.AREA_OFF_ON_ONE_SIDE: {"oil", "energy"},
    Fault.FRICTION_DRIVES: {"energy"},
    Fault.NO_REACTION_ON_BODY: {"momentum"},
    Fault.CELL_WITHOUT_REACTION: {"energy", "momentum"},
}


@pytest.mark.parametrize("fault", [f for f in Fault if f is not Fault.NONE], ids=lambda f: f.name)
def test_a_planted_bug_shows_in_just_these_books(fault: Fault) -> None:
    """A missing reaction passes oil and energy: it takes all three books."""
    found = balance(PLANT, *shaken(), fault=fault)
    wrong = {name for name in Balance._fields if getattr(found, name) > LIMIT}
    assert wrong == SEEN_IN[fault]


# ---- what the rig holds, each part from its definition ----


@given(st.floats(0.1e6, 40e6))
def test_head_is_the_integral_of_volume_over_pressure(pressure_pa: float) -> None:
    area, _ = quad(
        lambda p: specific_volume_law(PLANT, p)[0], 1e5, pressure_pa, epsrel=1e-11, limit=200
    )
    assert head(PLANT, pressure_pa) == pytest.approx(1e5 + area, rel=1e-9)


def test_head_at_exponents_of_one_is_the_limit() -> None:
    at_one = plant(fluid={"bulk_modulus_slope": 1.0, "air_n": 1.0})
    beside = plant(fluid={"bulk_modulus_slope": 1.0 + 1e-6, "air_n": 1.0 + 1e-6})
    assert head(at_one, 15e6) == pytest.approx(head(beside, 15e6), rel=1e-6)


def test_squeezing_a_chamber_stores_what_the_piston_does() -> None:
    """No oil in or out: dE = -p dV, summed along the way."""
    y, dx = pressurised(PLANT), 1e-6
    oil = 128.68e-6 / specific_volume_law(PLANT, y[P_1])[0]
    stored, drops = [], []
    for moved in dx * np.arange(400):
        y[X_R] = -moved  # into chamber 1, out of chamber 2
        y[P_1] = _pressure_at((128.68e-6 - 2.592e-3 * moved) / oil)
        y[P_2] = _pressure_at((128.68e-6 + 2.592e-3 * moved) / oil)
        stored.append(contents(PLANT, y)[1] - 0.5 * 800e6 * moved**2)  # less that of the load cell
        drops.append(y[P_1] - y[P_2])
    worked = 2.592e-3 * np.trapezoid(drops, dx=dx)
    assert stored[-1] - stored[0] == pytest.approx(worked, rel=1e-5)


def _pressure_at(v: float) -> float:
    low, high = 1e5, 4e7
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if specific_volume_law(PLANT, middle)[0] > v else (low, middle)
    return low


def test_gas_stores_the_work_of_its_polytropic_law() -> None:
    def energy(supply_pa: float) -> float:
        y = pressurised(PLANT)
        y[P_S] = supply_pa
        y[G_S] = 1e-3 * (12e6 / supply_pa) ** (1 / 1.3)
        return float(contents(PLANT, y)[1])

    work, _ = quad(lambda p: p * 1e-3 * (12e6 / p) ** (1 / 1.3) / (1.3 * p), 13e6, 20e6)
    assert energy(20e6) - energy(13e6) == pytest.approx(work, rel=1e-9)


def test_a_moving_body_has_its_energy_and_momentum() -> None:
    y = pressurised(PLANT)
    still = contents(PLANT, y)
    y[V_B] = -0.2
    moving = contents(PLANT, y)
    assert moving[0] == still[0]
    assert moving[1] - still[1] == pytest.approx(0.5 * 40.0 * 0.04, rel=1e-6)
    assert moving[2] == pytest.approx(-40.0 * 0.2)
    assert math.isclose(still[2], 0.0)
