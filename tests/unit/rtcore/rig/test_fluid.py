"""Oil: the table against the law, the law against its own derivative and against handbook figures."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.rig.constants import fluid_at_temperature
from rtcore.rig.fluid import specific_volume, specific_volume_law
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import FLUID_POINTS, FLUID_STEP_PA
from tests.unit.rtcore.rig.plants import plant

PLANT = plant()
pressures = st.floats(1e5, 40e6)


def v_by_hand(pressure_pa: float) -> float:
    """(1-α)(1 + m(p-p_ref)/β0)^(-1/m) + α(p_ref/p)^(1/n), as the rig's sheet has it."""
    alpha, m, n, beta0, ref = 0.005, 11.0, 1.3, 1.5e9, 1e5
    liquid = (1 + m * (pressure_pa - ref) / beta0) ** (-1 / m)
    return float((1 - alpha) * liquid + alpha * (ref / pressure_pa) ** (1 / n))


@given(pressures)
def test_the_law_is_that_of_the_sheet(pressure_pa: float) -> None:
    v, _ = specific_volume_law(PLANT, pressure_pa)
    assert v == pytest.approx(v_by_hand(pressure_pa), rel=1e-14)


@given(pressures)
def test_the_slope_of_the_law_is_its_derivative(pressure_pa: float) -> None:
    _, slope = specific_volume_law(PLANT, pressure_pa)
    step = 1e-4 * pressure_pa
    derivative = (v_by_hand(pressure_pa + step) - v_by_hand(pressure_pa - step)) / (2 * step)
    assert slope == pytest.approx(derivative, rel=1e-6)


@given(pressures)
def test_the_table_is_within_1e8_of_the_law(pressure_pa: float) -> None:
    v, _ = specific_volume(PLANT, pressure_pa)
    assert v == pytest.approx(v_by_hand(pressure_pa), rel=1e-8)


@given(st.floats(1e6, 40e6))
def test_the_table_is_within_1e12_of_the_law_above_1_mpa(pressure_pa: float) -> None:
    v, slope = specific_volume(PLANT, pressure_pa)
    assert v == pytest.approx(v_by_hand(pressure_pa), rel=1e-12)
    assert slope == pytest.approx(specific_volume_law(PLANT, pressure_pa)[1], rel=1e-7)


@given(st.integers(1, FLUID_POINTS - 3), st.floats(0.1, 0.9))
def test_the_slope_of_the_table_is_that_of_its_own_interpolant(point: int, share: float) -> None:
    """Mass closes exactly only so: the cubic between two points is differentiated exactly."""
    middle, step = (point + share) * FLUID_STEP_PA, 0.1 * FLUID_STEP_PA
    near, far = (
        (
            specific_volume(PLANT, middle + k * step)[0]
            - specific_volume(PLANT, middle - k * step)[0]
        )
        / (2 * k * step)
        for k in (0.5, 1.0)
    )
    slope = specific_volume(PLANT, middle)[1]
    assert slope == pytest.approx(
        (4 * near - far) / 3, rel=1e-7
    )  # exact for a cubic, but for rounding


@pytest.mark.parametrize("pressure_pa", [2e3, 9e3, 41e6, 60e6])
def test_beyond_the_table_the_law_answers(pressure_pa: float) -> None:
    assert specific_volume(PLANT, pressure_pa) == specific_volume_law(PLANT, pressure_pa)


def test_below_vapour_pressure_nothing_grows_without_bound() -> None:
    assert specific_volume(PLANT, -5e6) == specific_volume_law(PLANT, 1e3)
    assert math.isfinite(specific_volume(PLANT, -5e6)[0])


def test_free_air_softens_oil_at_low_pressure_only() -> None:
    def bulk_modulus(pressure_pa: float) -> float:
        v, slope = specific_volume(PLANT, pressure_pa)
        return float(-v / slope)

    assert bulk_modulus(0.3e6) < 0.2e9
    assert bulk_modulus(10e6) == pytest.approx(1.5e9 + 11 * 9.9e6, rel=0.02)
    moduli = [bulk_modulus(p) for p in np.linspace(0.3e6, 40e6, 200)]
    assert moduli == sorted(moduli)


def test_temperature_moves_the_oil_as_the_sheet_says() -> None:
    cold, warm, hot = (
        fluid_at_temperature(rig_from({"fluid": {"temperature_c": t}}).fluid) for t in (20, 40, 80)
    )
    assert warm == {
        "density_kg_m3": 833.0,
        "viscosity_m2_s": pytest.approx(14.3e-6),
        "bulk_modulus_pa": 1.5e9,
        "free_air": 0.005,
    }
    assert hot["density_kg_m3"] == pytest.approx(833.0 * 0.97)
    assert hot["viscosity_m2_s"] == pytest.approx(14.3e-6 * math.exp(-1.08))
    assert hot["bulk_modulus_pa"] == pytest.approx(1.22e9)
    assert hot["free_air"] == pytest.approx(0.007)
    assert cold["viscosity_m2_s"] > warm["viscosity_m2_s"]
