"""The curve through samples is scipy's monotone one, however it is cut into pieces."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as some
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

from app.histories.curve import pieces, steepest
from app.histories.statistics import bandwidth, survey

SOME = settings(max_examples=200, deadline=None)
values = some.arrays(
    np.float64,
    st.integers(2, 40),
    elements=st.sampled_from([0.0, 1.0, -3.0, 50e3])
    | st.floats(-50e3, 50e3).map(lambda v: round(v, 3)),
)


def _slopes(samples: np.ndarray, chunk: int) -> np.ndarray:
    found = list(pieces(samples, 0, chunk))
    np.testing.assert_array_equal(np.concatenate([part for _, part, _ in found]), samples)
    assert [first for first, _, _ in found] == list(range(0, len(samples), chunk))
    return np.concatenate([slopes for _, _, slopes in found])


@SOME
@given(values, st.integers(1, 10))
def test_slopes_are_those_of_scipy_in_pieces_of_any_length(samples: np.ndarray, chunk: int) -> None:
    places = np.arange(len(samples))
    independent = PchipInterpolator(places, samples).derivative()(places)
    np.testing.assert_allclose(_slopes(samples, chunk), independent, rtol=1e-9, atol=1e-6)


@SOME
@given(values)
def test_the_curve_overshoots_no_sample(samples: np.ndarray) -> None:
    curve = CubicHermiteSpline(np.arange(len(samples)), samples, _slopes(samples, 7))
    for i in range(len(samples) - 1):
        between = curve(np.linspace(i, i + 1, 33))
        low, high = sorted(samples[i : i + 2])
        assert between.min() >= low - 1e-6
        assert between.max() <= high + 1e-6


@SOME
@given(values)
def test_the_steepest_change_is_that_of_the_curve(samples: np.ndarray) -> None:
    slopes = _slopes(samples, 100)
    found = steepest(samples, slopes)
    rate = CubicHermiteSpline(np.arange(len(samples)), samples, slopes).derivative()
    for i, most in enumerate(found):
        looked = np.abs(rate(np.linspace(i, i + 1, 257))).max()
        assert looked <= most + 1e-6
        assert most <= looked * (1 + 1e-3) + 1e-6
    statistics = survey(samples)
    assert statistics.steepest == pytest.approx(found.max())
    assert found[statistics.steepest_at] == found.max()


def test_what_a_history_comes_to_does_not_depend_on_where_it_is_cut() -> None:
    samples = np.zeros(200_000)
    samples[65_535:65_537] = 1000.0, 4000.0  # across the first cut
    found = survey(samples)
    assert (found.samples, found.low, found.high) == (200_000, 0.0, 4000.0)
    assert found.steepest_at == 65_536
    assert found.steepest == pytest.approx(1.5 * 4000)  # between two level ends


@pytest.mark.parametrize("hz", [3.0, 40.0, 120.0])
@pytest.mark.parametrize("seconds", [8, 1500])
def test_the_bandwidth_of_a_sine_is_its_frequency(hz: float, seconds: int) -> None:
    rate_hz = 1000
    sine = 5.0 + np.sin(2 * math.pi * hz * np.arange(seconds * rate_hz) / rate_hz)
    assert bandwidth(sine) * rate_hz == pytest.approx(hz, abs=0.3)


def test_the_bandwidth_of_noise_is_where_its_filter_ends() -> None:
    spectrum = np.zeros(1 << 17, np.complex128)
    random = np.random.default_rng(1)
    spectrum[1 : 1 << 15] = np.exp(2j * math.pi * random.random((1 << 15) - 1))
    noise = np.fft.irfft(spectrum, 1 << 18)  # up to an eighth of the rate
    assert bandwidth(noise) == pytest.approx(0.125, rel=0.01)


def test_a_history_that_stands_still_has_no_bandwidth() -> None:
    assert bandwidth(np.full(5000, 7.0)) == 0.0
