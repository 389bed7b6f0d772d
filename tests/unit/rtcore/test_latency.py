"""Quantiles of the loop's histograms, against the samples that were put in."""

import numpy as np
import pytest

from rtcore.latency import Counts, longest_s, quantile_s
from rtcore.memory.layout import HISTOGRAM_BIN_S, HISTOGRAM_BINS


def histogram(samples_s: list[float]) -> Counts:
    edges = np.arange(HISTOGRAM_BINS + 1) * HISTOGRAM_BIN_S
    edges[-1] = np.inf
    return np.histogram(samples_s, edges)[0].astype(np.int64)


@pytest.mark.parametrize("share", [0.01, 0.5, 0.9, 0.99, 0.999])
def test_a_quantile_is_that_of_the_samples_to_a_bin(share: float) -> None:
    samples_s = np.random.default_rng(1).gamma(3.0, 8e-6, 20_000)
    found = quantile_s(histogram(samples_s.tolist()), share)
    assert found == pytest.approx(np.quantile(samples_s, share), abs=HISTOGRAM_BIN_S)


def test_within_a_bin_it_is_interpolated() -> None:
    counts = np.zeros(HISTOGRAM_BINS, np.int64)
    counts[20], counts[21] = 30, 70
    assert quantile_s(counts, 0.5) == pytest.approx(21e-6 + 20 / 70 * 1e-6)
    assert quantile_s(counts, 0.15) == pytest.approx(20.5e-6)


def test_nothing_is_claimed_of_the_overflow_or_of_no_samples() -> None:
    assert quantile_s(histogram([]), 0.5) is None
    assert longest_s(histogram([])) is None
    assert quantile_s(histogram([5e-6, 2e-3, 2e-3]), 0.5) is None
    assert longest_s(histogram([5e-6, 2e-3])) is None


def test_the_longest_is_the_upper_edge_of_its_bin() -> None:
    assert longest_s(histogram([2e-6, 41.5e-6, 7e-6])) == pytest.approx(42e-6)
