"""What an interval claims, against how much estimates of made-up data really scatter."""

import numpy as np
import numpy.typing as npt
import pytest
from scipy.signal import lfilter

from app.identification.choosing import most_telling
from app.identification.covariance import Spectra, coloured_meat, combined

Floats = npt.NDArray[np.float64]
WINDOWS, TICKS, TRIALS = 20, 400, 300
COLOUR = 0.9  # of an autoregression: one tick's residual is mostly that of the tick before


def slopes(chance: np.random.Generator) -> list[Floats]:
    """Two parameters seen in one channel: one slowly, one quickly."""
    t = np.arange(TICKS) / TICKS
    made = []
    for _ in range(WINDOWS):
        phase = chance.uniform(0, 2 * np.pi, 2)
        both = np.sin(2 * np.pi * 3 * t + phase[0]), np.sin(2 * np.pi * 80 * t + phase[1])
        made.append(np.stack(both, axis=-1)[:, None, :])
    return made


def noise(chance: np.random.Generator) -> Floats:
    return np.asarray(lfilter([1.0], [1.0, -COLOUR], chance.standard_normal(2 * TICKS))[TICKS:])


def estimated(seen: list[Floats], residuals: list[Floats]) -> tuple[Floats, Floats, Floats]:
    """The estimate, its claimed deviation, and what would be claimed if residuals were white."""
    flat = np.concatenate([s[:, 0, :] for s in seen])
    level = np.std(np.concatenate(residuals))
    inverse = np.linalg.inv(flat.T @ flat)
    at = inverse @ flat.T @ np.concatenate(residuals)
    left = [r - s[:, 0, :] @ at for r, s in zip(residuals, seen, strict=True)]
    spectra = Spectra()
    for residual in left:
        spectra.take(residual[:, None] / level)
    meat = sum(coloured_meat(s / level, spectra.density()) for s in seen)
    pulls = [s[:, 0, :].T @ r / level**2 for s, r in zip(seen, left, strict=True)]
    known = combined(inverse * level**2, np.asarray(meat), pulls, [np.zeros(2)])
    return at, known.deviation, level * np.sqrt(np.diag(inverse))


def test_intervals_of_coloured_residuals_are_as_wide_as_estimates_scatter() -> None:
    chance = np.random.default_rng(5)
    seen = slopes(chance)
    trials = [estimated(seen, [noise(chance) for _ in seen]) for _ in range(TRIALS)]
    scattered = np.std([at for at, _, _ in trials], axis=0)
    claimed = np.median([deviation for _, deviation, _ in trials], axis=0)
    white = np.median([deviation for _, _, deviation in trials], axis=0)
    assert white[0] < 0.45 * scattered[0]  # what a fit that takes them for white would claim
    assert claimed[0] == pytest.approx(scattered[0], rel=0.15)
    assert claimed[1] >= 0.95 * scattered[1]  # the white estimate is a floor here
    assert white[1] > 2.0 * scattered[1]


def test_intervals_of_white_residuals_are_no_wider_than_they_need_be() -> None:
    chance = np.random.default_rng(6)
    seen = slopes(chance)
    trials = [estimated(seen, [chance.standard_normal(TICKS) for _ in seen]) for _ in range(TRIALS)]
    scattered = np.std([at for at, _, _ in trials], axis=0)
    claimed = np.median([deviation for _, deviation, _ in trials], axis=0)
    assert claimed == pytest.approx(scattered, rel=0.2)


def test_what_all_windows_share_comes_on_top() -> None:
    inverse = np.diag([4.0, 1.0])
    known = combined(inverse, np.linalg.inv(inverse), [np.zeros(2)] * 3, [np.array([2.0, 0.0])])
    assert known.deviation == pytest.approx([np.sqrt(4.0 + 8.0**2), 1.0])
    assert known.reach == pytest.approx(4.303, abs=1e-3)  # Student's, of two degrees of freedom


def test_the_windows_that_tell_what_the_others_do_not_are_taken_first() -> None:
    loud, quiet, little = np.diag([1e6, 0.0]), np.diag([0.0, 1e2]), np.diag([1e1, 1e1])
    chosen = most_telling([little, loud, loud * 0.99, quiet], np.eye(2), 2)
    assert chosen == [1, 3]
    assert most_telling([little, loud], np.eye(2), 5) == [0, 1]
