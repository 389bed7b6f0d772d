"""The discrete filters against scipy's bilinear transform and python-control's, and run through time."""

import math
from collections.abc import Callable
from typing import Any

import control
import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from rtcore.control.filters import (
    FILTER,
    clear_filter,
    design_lead,
    design_low_pass,
    design_notch,
    filter_step,
)
from rtcore.control.response import filter_response, shift
from tests.unit.rtcore.control.laws import PERIOD_S

T = PERIOD_S
RATE_HZ = 1 / T
corners_hz = st.floats(0.5, 600.0)
dampings = st.floats(0.05, 2.0)
frequencies_hz = st.floats(0.1, 1900.0)
Polynomials = tuple[list[float], list[float]]


def designed(design: Callable[..., None], *arguments: float) -> Any:
    """A FILTER record."""
    record = np.zeros(1, FILTER)[0]
    design(record, *arguments, T)
    return record


def coefficients(f: Any) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """(b, a) of a FILTER record."""
    return np.array([f["b0"], f["b1"], f["b2"]]), np.array([1.0, f["a1"], f["a2"]])


def response(f: Any, frequency_hz: float) -> complex:
    return filter_response(f, shift(frequency_hz, T))


def tustin(polynomials: Polynomials, frequency_hz: float) -> complex:
    """By scipy's bilinear transform."""
    b, a = signal.bilinear(*polynomials, fs=RATE_HZ)
    return complex(signal.freqz(b, a, [frequency_hz], fs=RATE_HZ)[1][0])


def prewarped(polynomials: Polynomials, omega: float, frequency_hz: float) -> complex:
    """By python-control, exact at `omega`."""
    plain = control.tf(*polynomials)
    sampled = control.sample_system(plain, T, method="bilinear", prewarp_frequency=omega)
    return complex(sampled(np.exp(2j * np.pi * frequency_hz * T)))


@given(corners_hz, corners_hz, frequencies_hz)
def test_the_lead_is_tustins(zero_hz: float, pole_hz: float, frequency_hz: float) -> None:
    zero, pole = 2 * math.pi * zero_hz, 2 * math.pi * pole_hz
    found = response(designed(design_lead, zero, pole), frequency_hz)
    wanted = tustin(([1 / pole, zero / pole], [1 / pole, 1.0]), frequency_hz)
    assert found == pytest.approx(wanted, rel=1e-6)


@given(corners_hz, frequencies_hz)
def test_the_first_order_low_pass_is_tustins(corner_hz: float, frequency_hz: float) -> None:
    omega = 2 * math.pi * corner_hz
    found = response(designed(design_low_pass, omega, 0.7, 1), frequency_hz)
    wanted = tustin(([1.0], [1 / omega, 1.0]), frequency_hz)
    assert found == pytest.approx(wanted, rel=1e-6, abs=1e-12)


@given(corners_hz, dampings, frequencies_hz)
def test_the_second_order_low_pass_is_prewarped(
    corner_hz: float, zeta: float, frequency_hz: float
) -> None:
    omega = 2 * math.pi * corner_hz
    found = response(designed(design_low_pass, omega, zeta, 2), frequency_hz)
    second_order = ([omega**2], [1.0, 2 * zeta * omega, omega**2])
    assert found == pytest.approx(prewarped(second_order, omega, frequency_hz), rel=1e-5, abs=1e-9)


@given(corners_hz, dampings, frequencies_hz)
def test_the_notch_is_prewarped(centre_hz: float, zeta: float, frequency_hz: float) -> None:
    omega = 2 * math.pi * centre_hz
    found = response(designed(design_notch, omega, zeta), frequency_hz)
    notch = ([1.0, 0.0, omega**2], [1.0, 2 * zeta * omega, omega**2])
    assert found == pytest.approx(prewarped(notch, omega, frequency_hz), rel=1e-5, abs=1e-7)


@given(st.floats(1.0, 1500.0), dampings)
def test_the_notch_lets_nothing_through_at_its_centre(centre_hz: float, zeta: float) -> None:
    notch = designed(design_notch, 2 * math.pi * centre_hz, zeta)
    # Far below the rate both polynomials are small differences of numbers near 2: that is their rounding.
    rounding = 16 * np.finfo(float).eps / (zeta * (2 * math.pi * centre_hz * T) ** 2)
    assert abs(response(notch, centre_hz)) < 1e-12 + rounding
    assert abs(response(notch, 1e-6)) == pytest.approx(1.0, rel=1e-6)


@given(corners_hz, corners_hz)
def test_the_lead_is_one_far_above_and_the_ratio_of_corners_below(
    zero_hz: float, pole_hz: float
) -> None:
    lead = designed(design_lead, 2 * math.pi * zero_hz, 2 * math.pi * pole_hz)
    assert abs(response(lead, RATE_HZ / 2)) == pytest.approx(1.0, rel=1e-9)
    assert abs(response(lead, 1e-9)) == pytest.approx(zero_hz / pole_hz, rel=1e-5)


@given(corners_hz, dampings, st.sampled_from([1, 2]))
def test_a_low_pass_keeps_a_constant_and_is_stable(
    corner_hz: float, zeta: float, order: int
) -> None:
    b, a = coefficients(designed(design_low_pass, 2 * math.pi * corner_hz, zeta, order))
    assert np.sum(b) / np.sum(a) == pytest.approx(1.0, rel=1e-6)
    assert np.all(np.abs(np.roots(a)) < 1.0)


@pytest.mark.parametrize(
    "f",
    [
        designed(design_lead, 6.3, 19.0),
        designed(design_low_pass, 75.0, 0.7, 1),
        designed(design_low_pass, 75.0, 0.7, 2),
        designed(design_notch, 314.0, 0.15),
    ],
    ids=["lead", "low_pass_1", "low_pass_2", "notch"],
)
def test_through_time_a_filter_is_its_difference_equation(f: Any) -> None:
    samples = np.random.default_rng(2).normal(size=400)
    found = [filter_step(f, x) for x in samples]
    assert found == pytest.approx(signal.lfilter(*coefficients(f), samples), rel=1e-9, abs=1e-12)
    clear_filter(f)
    assert [filter_step(f, x) for x in samples[:50]] == found[:50]
