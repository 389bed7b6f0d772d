"""Restrictions: the closed-form flow put back into the law that it solves."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.rig.restriction import flows4
from rtcore.rig.servovalve import land_flows
from tests.unit.rtcore.rig.plants import plant

drops = st.floats(-4e7, 4e7)
laminar = st.floats(1e5, 1e12)
turbulent = st.floats(1e9, 1e17)


@given(st.tuples(drops, drops, drops, drops), laminar, turbulent)
def test_each_of_four_flows_takes_exactly_its_drop(
    four: tuple[float, float, float, float], r: float, k: float
) -> None:
    flows = flows4(*four, r, 2 * r, 3 * r, 4 * r, k, 2 * k, 3 * k, 4 * k)
    for i, (drop, flow) in enumerate(zip(four, flows, strict=True), start=1):
        assert i * r * flow + i * k * flow * abs(flow) == pytest.approx(drop, rel=1e-12, abs=1e-12)


@given(laminar, turbulent)
def test_the_slope_at_no_drop_is_finite(r: float, k: float) -> None:
    tiny = 1e-9 * r * r / k
    flow = flows4(tiny, 0.0, -tiny, 0.0, r, r, r, r, k, k, k, k)
    assert flow[0] == pytest.approx(tiny / r, rel=1e-6)
    assert flow[1] == 0.0
    assert flow[2] == -flow[0]


# ---- the lands, against the discharge law that their closed form stands for ----

RHO, NU, W, CD, RE_TR, CLEARANCE, LAP = 833.0, 14.3e-6, 0.023, 0.62, 15.0, 4e-6, 4e-6
P_SUPPLY, P_ONE, P_TWO, P_RETURN = 20.9e6, 12e6, 8e6, 0.4e6


def orifice(opening_m: float, drop_pa: float) -> float:
    """Q = C_d(Re) w h √(2Δp/ρ) with C_d = C_d∞ √(Re/(Re + Re_tr)) and Re = 2Q/(wν), by iteration."""
    h = math.hypot(max(opening_m, 0.0), CLEARANCE)
    flow = ideal = CD * W * h * math.sqrt(2 * drop_pa / RHO)
    for _ in range(200):
        reynolds = 2 * flow / (W * NU)
        flow = ideal * math.sqrt(reynolds / (reynolds + RE_TR))
    return flow


@pytest.mark.parametrize("share", [0.002, 0.05, 0.3, 1.0])
def test_an_open_land_follows_its_discharge_law(share: float) -> None:
    x = share * 0.8e-3
    pa, _, _, bt = land_flows(plant(), x, P_SUPPLY, P_ONE, P_TWO, P_RETURN)
    assert pa == pytest.approx(orifice(x + LAP, P_SUPPLY - P_ONE), rel=1e-9)
    assert bt == pytest.approx(orifice(x + LAP, P_TWO - P_RETURN), rel=1e-9)


def test_a_covered_land_leaks_through_its_gap() -> None:
    """Far under its lap a land is a laminar gap: Q = w c_r³ Δp/(12 ρ ν l), with l its cover."""
    _, at, pb, _ = land_flows(plant(), 0.5e-3, P_SUPPLY, P_ONE, P_TWO, P_RETURN)
    cover = 0.5e-3 - LAP
    for flow, drop in ((at, P_ONE - P_RETURN), (pb, P_SUPPLY - P_TWO)):
        gap = W * CLEARANCE**3 * drop / (12 * RHO * NU * cover)
        assert 0.9 * gap < flow < gap


def test_the_lands_mirror_each_other() -> None:
    pa, at, pb, bt = land_flows(plant(), 0.1e-3, P_SUPPLY, P_ONE, P_TWO, P_RETURN)
    mirrored = land_flows(plant(), -0.1e-3, P_SUPPLY, P_TWO, P_ONE, P_RETURN)
    assert mirrored == (pb, bt, pa, at)


def test_a_null_offset_is_a_shift_of_the_spool() -> None:
    shifted = plant(servovalve={"null_m": 2e-5})
    at_null = land_flows(shifted, 0.0, P_SUPPLY, P_ONE, P_TWO, P_RETURN)
    assert at_null == land_flows(plant(), 2e-5, P_SUPPLY, P_ONE, P_TWO, P_RETURN)
