"""The response of a sweep on the virtual rig, against sines of the same amplitude, to its very ends."""

from typing import Any

import numpy as np
import pytest

from app.conducting.responding import Responding
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from rtcore.modes import Mode
from tests.unit.app.conducting.responses import play, points_of, response_test

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


@pytest.mark.parametrize("before", ["a load", "a rest"])
def test_beside_another_load_only_what_can_be_told_from_its_ringing_is_told(before: str) -> None:
    load = {"kind": "harmonic", "amplitude_n": 20_000.0, "frequency_hz": 25.0, "cycles": 25}
    rest = [] if before == "a load" else [{"kind": "hold", "duration_s": 0.2}]
    asked = sweep(from_hz=30.0, to_hz=100.0).blocks[0].model_dump(mode="json", exclude_none=True)
    data = {"schema": 1, "name": "two", "blocks": [load, *rest, asked]}
    points = [
        point
        for point in play(Definition.model_validate(data)).points
        if point.amplitude_n == AMPLITUDE_N
    ]
    reached_hz = max(point.frequency_hz for point in points)
    assert (reached_hz == 100.0) == (before == "a rest")
    alone = play(sweep(from_hz=30.0, to_hz=100.0)).by_frequency()
    for point in points:
        same = alone[round(point.frequency_hz, 2)]
        assert point.gain == pytest.approx(same.gain, rel=0.04)


@pytest.mark.parametrize("mean_n", [0.0, 5000.0])
def test_its_points_come_after_it_however_its_ticks_are_cut(mean_n: float) -> None:
    definition = sweep(from_hz=30.0, to_hz=100.0, mean_n=mean_n)
    records = play(definition).records
    whole = points_of(definition, records)
    over = int(np.flatnonzero(records["mode"] == Mode.STOPPING)[0])
    assert points_of(definition, records[:over]) == []
    responding = Responding(definition, RIG.period_s)
    for part in np.array_split(records, 311):
        responding.take(part)
    cut = [found.point for found in responding.points() if found.point.transfer == "force"]
    assert cut == whole


def test_about_a_mean_that_is_left_at_once_its_end_is_not_told() -> None:
    keys = {"from_hz": 30.0, "to_hz": 100.0, "mean_n": 5000.0}
    points = play(sweep(**keys)).points
    assert 75.0 < max(point.frequency_hz for point in points) < 95.0
    assert all(point.gain_95.low > 0.5 * point.gain for point in points)
