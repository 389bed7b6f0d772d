"""Multisines and sweeps on the virtual rig give what stepped sines give."""

import math
from typing import Any

import numpy as np
import pytest

from app.analysis.response.point import ResponsePoint
from app.conducting.found import Found
from app.conducting.responding import Responding
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from rtcore.modes import Mode
from tests.unit.app.conducting.responses import play, response_test

FREQUENCIES_HZ = [10.0, 20.0, 40.0, 80.0]
STEPPED, SMALLER = (
    response_test(frequencies_hz=FREQUENCIES_HZ, amplitudes_n=[amplitude_n], measure_cycles=10)
    for amplitude_n in (2000.0, 1000.0)
)


def found_in(definition: Definition, records: Any) -> list[Found]:
    responding = Responding(definition, RIG.period_s)
    for chunk in np.array_split(records, 50):
        responding.take(chunk)
    return [found for found in responding.points() if found.point.transfer == "force"]


def gain_db(point: ResponsePoint) -> float:
    return 20 * math.log10(point.gain)


def sweep(**other: Any) -> Definition:
    block = {
        "kind": "sweep",
        "amplitude_n": 1000.0,
        "from_hz": 8.0,
        "to_hz": 100.0,
        "duration_s": 10.0,
    }
    return Definition.model_validate({"schema": 1, "name": "sweep", "blocks": [block | other]})


@pytest.mark.parametrize("taper_cycles", [0, 2])
def test_a_sweep_gives_what_stepped_sines_give(taper_cycles: int) -> None:
    definition = sweep(taper_cycles=taper_cycles)
    found = found_in(definition, play(definition).records)
    assert {one.method for one in found} == {"sweep"}
    octaves = [math.log2(one.point.frequency_hz) for one in found]
    gains_db = [gain_db(one.point) for one in found]
    for point in play(SMALLER).points:
        at = np.interp(math.log2(point.frequency_hz), octaves, gains_db)
        assert at == pytest.approx(gain_db(point), abs=0.6)  # friction: the rig is not quite linear


def test_a_sweep_that_was_held_has_no_response() -> None:
    definition = sweep()
    records = play(definition).records.copy()
    records["mode"][20_000:20_500] = Mode.HOLDING
    assert found_in(definition, records) == []


def test_a_sweep_that_is_not_over_has_no_response_yet() -> None:
    definition = sweep()
    assert found_in(definition, play(definition).records[:30_000]) == []


@pytest.mark.parametrize("more", [{}, {"realisations": 3}, {"lines": "odd_random"}], ids=str)
def test_a_multisine_gives_what_stepped_sines_give(more: dict[str, Any]) -> None:
    lines = [float(hz) for hz in (range(1, 100, 2) if more.get("lines") else range(10, 100, 10))]
    asked = {"method": "multisine", "frequencies_hz": lines, "amplitudes_n": [3000.0]}
    definition = response_test(**asked, settle_cycles=1, measure_cycles=6, **more)
    found = found_in(definition, play(definition).records)
    assert {one.method for one in found} == {"multisine"}
    assert all(one.noise_std is not None for one in found)
    assert (more == {}) == all(one.nonlinear_std is None for one in found)
    octaves = [math.log2(one.point.frequency_hz) for one in found]
    gains_db = [gain_db(one.point) for one in found]
    for point in play(STEPPED).points:
        at = np.interp(math.log2(point.frequency_hz), octaves, gains_db)
        assert at == pytest.approx(gain_db(point), abs=1.0)


def test_several_realisations_are_one_point_a_line() -> None:
    asked = {"method": "multisine", "frequencies_hz": [10.0, 20.0, 30.0], "realisations": 2}
    definition = response_test(**asked, settle_cycles=1, measure_cycles=4, means_n=[0.0, 1000.0])
    found = found_in(definition, play(definition).records)
    assert [(one.point.mean_n, one.point.frequency_hz) for one in found] == [
        (mean, hz) for mean in (0.0, 1000.0) for hz in (10.0, 20.0, 30.0)
    ]
