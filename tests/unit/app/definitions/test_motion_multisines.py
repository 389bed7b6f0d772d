"""A multisine of the unit under test: its lines by Fourier's transform, and what is refused."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.errors import Refusal
from tests.unit.app.definitions import bad
from tests.unit.app.definitions.playing import play

RATE_HZ = 4000
LINES = [2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
LEAD_TICKS = round(math.pi / 2 * 2 * 0.03 / 0.2 * RATE_HZ)
Waves = npt.NDArray[np.float64]


def multisine(**changed: Any) -> bad.Data:
    """A motion; None leaves a key out."""
    motion = {"kind": "multisine", "amplitude_m": 0.0005, "frequencies_hz": LINES} | changed
    return {key: value for key, value in motion.items() if value is not None}


def read(**changed: Any) -> Definition | Refusal:
    return definition_from(bad.with_blocks(bad.hold(), motion=[multisine(**changed)]))


def played(definition: Definition | Refusal, realisations: int, periods: int) -> Waves:
    """(realisations, periods, 4000): the command in each period of a second."""
    assert isinstance(definition, Definition), definition.detail
    ticks = LEAD_TICKS + periods * RATE_HZ
    assert outline(definition).motion_duration_s == pytest.approx(realisations * ticks / RATE_HZ)
    value = play(expand(definition).motion, realisations * ticks + 1).value
    each = value[: realisations * ticks].reshape(realisations, ticks)
    return each[:, LEAD_TICKS:].reshape(realisations, periods, RATE_HZ)


def amplitudes(wave: Waves) -> Waves:
    """Of 0, 1, 2 … Hz."""
    return np.asarray(np.abs(np.fft.rfft(wave)) / (RATE_HZ / 2))


@pytest.mark.parametrize("mean_m", [0.0, -0.002])
def test_every_realisation_has_its_lines_alone_in_every_period(mean_m: float) -> None:
    waves = played(read(mean_m=mean_m, realisations=3, settle_cycles=1, measure_cycles=1), 3, 2)
    at = [round(hz) for hz in LINES]
    for first, second in waves:
        np.testing.assert_allclose(first, second, atol=1e-12)
        found = amplitudes(first - mean_m)
        np.testing.assert_allclose(found[at], found[at[0]], rtol=1e-6)
        assert np.delete(found, at).max() < 1e-9 * found.max()
        assert np.abs(first - mean_m).max() == pytest.approx(0.0005)
    turned = np.angle(np.fft.rfft(waves[:, 0])[:, at])
    assert all(np.abs(a - b).max() > 0.1 for a, b in pairwise(turned))


def test_above_a_corner_every_line_has_the_same_velocity() -> None:
    waves = played(read(corner_hz=10.0, realisations=2), 2, 3)
    found = amplitudes(waves[0, 0])
    shares = [found[round(hz)] / found[2] for hz in LINES]
    assert shares == pytest.approx([1, 1, 1, 0.5, 0.2, 0.1], rel=1e-6)


def test_velocity_has_little_crest() -> None:
    """Random phases have twice as much, and would be played at half the amplitude."""
    waves = played(read(frequencies_hz=[float(hz) for hz in range(3, 100, 4)]), 4, 3)
    for wave in waves[:, 0]:
        velocity = np.diff(wave, append=wave[0])
        assert np.abs(velocity).max() / np.std(velocity) < 1.9


def test_too_fast_a_multisine_is_refused_with_an_amplitude_that_would_do() -> None:
    refused = read(amplitude_m=0.002)
    assert isinstance(refused, Refusal)
    (fault,) = refused.faults
    assert fault.path == "motion[0].amplitude_m"
    assert "must be at most 0.2 m/s" in fault.expected
    would_do = float(fault.expected.rsplit(": ", 1)[1].split()[0])
    assert isinstance(read(amplitude_m=would_do), Definition)
    assert isinstance(read(amplitude_m=1.02 * would_do), Refusal)


@pytest.mark.parametrize(
    ("changed", "path", "says"),
    [
        ({"mean_m": 0.0299, "amplitude_m": 0.0002}, "amplitude_m", "at most 0.03 m"),
        ({"frequencies_hz": [2.001, 3.0]}, "frequencies_hz", "common period"),
        ({"realisations": 1}, "realisations", "at least 2"),
        ({"amplitude_m": 0.0}, "amplitude_m", "above 0 m"),
        ({"corner_hz": 0.0}, "corner_hz", "at least"),
        ({"amplitude_n": 2.0}, "amplitude_n", "amplitude_m"),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused_where_it_stands(
    changed: dict[str, Any], path: str, says: str
) -> None:
    refused = read(**changed)
    assert isinstance(refused, Refusal)
    assert any(f.path == f"motion[0].{path}" and says in f.expected for f in refused.faults)
