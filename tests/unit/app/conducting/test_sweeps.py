"""The response of a sweep on the virtual rig, against sines of the same amplitude, to its very ends."""

from typing import Any

import numpy as np
import pytest

from app.definitions.definition import Definition
from tests.unit.app.conducting.responses import play, response_test

AMPLITUDE_N = 1000.0
SINES_HZ = [45.0, 60.0, 75.0, 90.0, 100.0]


def sweep(**keys: Any) -> Definition:
    asked = {"kind": "sweep", "amplitude_n": AMPLITUDE_N, "rate_octaves_s": 0.5, **keys}
    return Definition.model_validate({"schema": 1, "name": "sweep", "blocks": [asked]})


@pytest.mark.parametrize("law", ["log", "linear"])
def test_a_sweep_finds_what_sines_find_up_to_its_last_frequency(law: str) -> None:
    sines = play(
        response_test(amplitudes_n=[AMPLITUDE_N], frequencies_hz=SINES_HZ, measure_cycles=30)
    ).by_frequency()
    swept = play(sweep(from_hz=30.0, to_hz=100.0, law=law)).by_frequency()
    assert max(swept) == 100.0
    found_hz = np.array(list(swept))
    found = np.array([p.gain * np.exp(1j * np.radians(p.phase_deg)) for p in swept.values()])
    for hz, sine in sines.items():
        gain = np.interp(hz, found_hz, np.abs(found))
        assert 20 * np.log10(gain / sine.gain) == pytest.approx(0.0, abs=0.25)
        phase_deg = np.interp(hz, found_hz, np.degrees(np.unwrap(np.angle(found))))
        assert phase_deg == pytest.approx(sine.phase_deg, abs=2.0)


def test_nothing_is_told_of_its_first_cycles_from_rest() -> None:
    points = play(sweep(from_hz=100.0, to_hz=30.0)).points
    assert 85.0 < max(point.frequency_hz for point in points) < 97.0
    assert all(point.gain_95.low > 0.5 * point.gain for point in points)


def test_one_that_ends_at_once_tells_only_what_can_be_told_from_its_end() -> None:
    points = play(sweep(from_hz=30.0, to_hz=100.0, taper_cycles=0.0)).points
    assert 75.0 < max(point.frequency_hz for point in points) < 95.0
    assert all(point.gain_95.low > 0.5 * point.gain for point in points)
