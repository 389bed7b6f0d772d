"""Noise: the published generator, the normal distribution, and the same for the same seed."""

import math

import numpy as np
import pytest
from scipy import stats

from rtcore.rig.noise import NOISE, seed_noise, two_normals

N = 20_000
MASK = (1 << 64) - 1


def samples(seed: int, count: int = N) -> np.ndarray:
    """(count, 2) of one generator."""
    noise = np.zeros(1, NOISE)[0]
    seed_noise(noise, seed)
    return np.array([two_normals(noise) for _ in range(count)])


SAMPLES = samples(1)


def test_the_generator_is_xoroshiro128_plus_with_box_muller() -> None:
    """Blackman and Vigna's own code, in whole numbers of Python."""

    def rotated(x: int, by: int) -> int:
        return ((x << by) | (x >> (64 - by))) & MASK

    state, words = 42, []
    for _ in range(2):
        state = (state + 0x9E3779B97F4A7C15) & MASK
        z = ((state ^ (state >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        words.append(z ^ (z >> 31))
    s0, s1 = words

    def uniform() -> float:
        nonlocal s0, s1
        total = (s0 + s1) & MASK
        s1 ^= s0
        s0 = rotated(s0, 24) ^ s1 ^ ((s1 << 16) & MASK)
        s1 = rotated(s1, 37)
        return ((total >> 11) + 1) / 2**53

    for found in samples(42, 50):
        radius, angle = math.sqrt(-2 * math.log(uniform())), 2 * math.pi * uniform()
        assert found == pytest.approx([radius * math.cos(angle), radius * math.sin(angle)])


@pytest.mark.parametrize("stream", [0, 1])
def test_each_stream_is_standard_normal(stream: int) -> None:
    values = SAMPLES[:, stream]
    assert abs(np.mean(values)) < 4 / math.sqrt(N)
    assert abs(np.var(values) - 1) < 4 * math.sqrt(2 / N)
    assert stats.kstest(values, "norm").pvalue > 1e-3
    assert np.max(np.abs(values)) > 3.5  # it has tails


def test_the_noise_is_white_and_its_streams_are_independent() -> None:
    bound = 4 / math.sqrt(N)
    a, b = SAMPLES.T
    assert abs(np.mean(a * b)) < bound
    for lag in (1, 2, 3, 10):
        assert abs(np.mean(a[:-lag] * a[lag:])) < bound
        assert abs(np.mean(a[:-lag] * b[lag:])) < bound


def test_the_same_seed_gives_the_same_noise_bit_for_bit() -> None:
    assert np.array_equal(samples(7, 100), samples(7, 100))


@pytest.mark.parametrize("seed", [0, -1, 2, 2**70])
def test_any_whole_number_is_a_seed_of_its_own(seed: int) -> None:
    found = samples(seed, 200)
    assert np.all(np.isfinite(found))
    assert not np.array_equal(found, SAMPLES[:200])
    assert abs(np.corrcoef(found[:, 0], SAMPLES[:200, 0])[0, 1]) < 0.3
