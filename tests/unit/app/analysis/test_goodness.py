"""The paper's confidence parameter, eq. (4), against values worked out by hand."""

import math

import numpy as np
import pytest

from app.analysis.goodness import goodness_of_fit

TURN = np.sin(2 * np.pi * np.arange(1000) / 1000)


def test_a_perfect_match_is_100() -> None:
    assert goodness_of_fit(2000 * TURN, 2000 * TURN) == 100


@pytest.mark.parametrize("offset_n", [20.0, -100.0])
def test_a_constant_error_counts_by_its_share_of_the_peak(offset_n: float) -> None:
    expected = 100 * (1 - abs(offset_n) / 2000)
    assert goodness_of_fit(2000 * TURN, 2000 * TURN + offset_n) == pytest.approx(expected)


def test_the_peak_is_that_of_the_measured_force() -> None:
    # rms of a sine is its amplitude over √2; the error is half the measured amplitude
    assert goodness_of_fit(2000 * TURN, 3000 * TURN) == pytest.approx(100 * (1 - 0.5 / 2**0.5))
    assert goodness_of_fit(3000 * TURN, 2000 * TURN) == pytest.approx(100 * (1 - 1 / 3 / 2**0.5))
    # the peak counts either way: here it is negative
    assert goodness_of_fit(TURN - 3, TURN - 3.4) == pytest.approx(100 * (1 - 0.4 / 4))


def test_a_force_of_zero_has_no_goodness() -> None:
    assert math.isnan(goodness_of_fit(np.zeros(10), np.ones(10)))


def test_what_is_not_measured_makes_no_good_fit() -> None:
    assert math.isnan(goodness_of_fit(np.array([1.0, np.nan]), np.ones(2)))


@pytest.mark.parametrize(("n", "m"), [(0, 0), (10, 11)])
def test_samples_have_to_belong_together(n: int, m: int) -> None:
    with pytest.raises(ValueError, match="samples against"):
        goodness_of_fit(np.ones(n), np.ones(m))
