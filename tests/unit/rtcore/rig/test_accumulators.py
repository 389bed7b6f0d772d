"""Accumulators: the gas follows p V^n, by the equations of motion and where a tick ends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.rig.derivatives import derivatives
from rtcore.rig.integrate import settle_gas, settle_pressures
from rtcore.rig.plant import (
    FLOWS,
    G_S,
    G_T,
    P_1,
    P_2,
    P_S,
    P_T,
    Q_AT,
    Q_BLEED,
    Q_BT,
    Q_PA,
    Q_PB,
    Q_PUMP,
    Q_RELIEF,
    Q_TANK,
    STATES,
    U_BLEED,
    U_PUMP,
)
from tests.unit.rtcore.rig.plants import inputs, plant, pressurised

PLANT = plant()
N = 1.3
PRECHARGE_S, VOLUME_S = 12e6, 1e-3
PRECHARGE_T, VOLUME_T = 0.2e6, 0.5e-3


@given(st.floats(12.001e6, 40e6), st.floats(0.2e6, 2e6))
def test_gas_is_settled_on_the_polytropic_law(supply_pa: float, return_pa: float) -> None:
    y = pressurised(PLANT)
    y[P_S], y[P_T] = supply_pa, return_pa
    settle_gas(PLANT, y)
    assert supply_pa * y[G_S] ** N == pytest.approx(PRECHARGE_S * VOLUME_S**N, rel=1e-12)
    assert return_pa * y[G_T] ** N == pytest.approx(PRECHARGE_T * VOLUME_T**N, rel=1e-12)


def test_below_its_precharge_the_gas_fills_the_accumulator_and_the_hoses_lack_oil() -> None:
    y = pressurised(PLANT)
    y[P_S] = 11e6
    settle_gas(PLANT, y)
    assert y[G_S] - VOLUME_S == pytest.approx(4e-12 * 1e6)


@given(st.floats(0.1e6, 40e6), st.floats(0.2e6, 2e6))
def test_pressure_and_gas_belong_to_each_other(supply_pa: float, return_pa: float) -> None:
    y = pressurised(PLANT)
    y[P_S], y[P_T] = supply_pa, return_pa
    settle_gas(PLANT, y)
    y[P_S], y[P_T] = 0.0, 0.0
    settle_pressures(PLANT, y)
    assert y[P_S] == pytest.approx(supply_pa, rel=1e-9)
    assert y[P_T] == pytest.approx(return_pa, rel=1e-9)


def rates(supply_pa: float, pump_pa: float, bleeding: float) -> tuple[np.ndarray, ...]:
    """(state, dy/dt, flows) with the supply at a pressure, charged by a pump, or bled."""
    y, q, dy = pressurised(PLANT), np.zeros(FLOWS), np.zeros(STATES)
    y[P_S], y[P_T], y[P_1], y[P_2] = supply_pa, 0.35e6, 6e6, 5e6
    settle_gas(PLANT, y)
    u = inputs(1)[0]
    u[U_PUMP], u[U_BLEED] = pump_pa, bleeding
    derivatives(PLANT, y, u, q, dy)
    return y, dy, q


@given(st.floats(12.1e6, 25e6), st.floats(0.3e6, 25e6), st.sampled_from([0.0, 1.0]))
def test_pressure_and_gas_move_along_the_law(
    supply_pa: float, pump_pa: float, bleeding: float
) -> None:
    """d(p V^n) = 0, which is dp/p = -n dV/V."""
    y, dy, _ = rates(supply_pa, pump_pa, bleeding)
    for p, g in ((P_S, G_S), (P_T, G_T)):
        assert dy[p] / y[p] == pytest.approx(-N * dy[g] / y[g], rel=1e-12, abs=1e-15)


@given(st.floats(12.1e6, 25e6), st.floats(0.3e6, 25e6), st.sampled_from([0.0, 1.0]))
def test_gas_gives_way_to_the_oil_that_comes(
    supply_pa: float, pump_pa: float, bleeding: float
) -> None:
    _, dy, q = rates(supply_pa, pump_pa, bleeding)
    into_s = q[Q_PUMP] - q[Q_RELIEF] - q[Q_BLEED] - q[Q_PA] - q[Q_PB]
    into_t = q[Q_AT] + q[Q_BT] - q[Q_TANK]
    assert dy[G_S] == pytest.approx(-into_s, rel=1e-12)
    assert dy[G_T] == pytest.approx(-into_t, rel=1e-12)


def test_below_precharge_only_the_hoses_are_elastic() -> None:
    _, dy, q = rates(8e6, 9e6, 0.0)
    into_s = q[Q_PUMP] - q[Q_PA] - q[Q_PB]
    assert dy[G_S] == pytest.approx(-into_s)
    assert dy[P_S] == pytest.approx(into_s / 4e-12)


def test_a_pump_lets_nothing_back_and_a_relief_valve_opens_above_its_pressure() -> None:
    _, _, q = rates(20e6, 15e6, 0.0)
    assert q[Q_PUMP] == 0.0
    assert q[Q_RELIEF] == 0.0
    _, _, q = rates(24e6, 24e6, 0.0)
    assert q[Q_RELIEF] == pytest.approx(1e-9 * 0.5e6)
    assert q[Q_BLEED] == 0.0


def test_the_bleed_valve_passes_its_rated_flow_at_full_pressure() -> None:
    _, _, q = rates(21e6, 0.3e6, 1.0)
    assert q[Q_BLEED] == pytest.approx(1e-3, rel=0.06)  # a twentieth of its loss is laminar
