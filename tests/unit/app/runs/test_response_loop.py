"""The open loop of a run on the virtual rig: that which closes to the closed loop of the very same run."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.conducting.found import Found
from app.conducting.responding import Responding
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.runs.response_loop import available_of, loop_margins, loop_points
from app.runs.response_series import series_of
from bench.recorded import make_test
from rtcore.control.response import feed_forward_response, pid_response, shift
from rtcore.rig.parameters import load_rig
from tests.unit.app.conducting.responses import played

SETTINGS = ControllerSettings()
FREQUENCIES = [12.0, 30.0, 40.0, 46.0, 52.0, 70.0, 150.0, 250.0]
STEPPED = {
    "kind": "frequency_response",
    "amplitudes_n": [3000.0],
    "frequencies_hz": FREQUENCIES,
    "settle_cycles": 8,
    "measure_cycles": 10,
}
MULTISINE = {
    "kind": "frequency_response",
    "method": "multisine",
    "amplitudes_n": [3000.0],
    "frequencies_hz": [12.0, 20.0, 32.0, 44.0, 60.0, 80.0],
    "settle_cycles": 2,
    "measure_cycles": 4,
}


def found(block: dict[str, Any], compensation: str = "auto") -> tuple[Definition, list[Found]]:
    definition = make_test([block], compensation=compensation)
    responding = Responding(definition, RIG.period_s, rig=load_rig())
    responding.take(played(definition).records)
    return definition, responding.points()


def looped(
    definition: Definition, points: list[Found], load_hz: float | None = None
) -> list[Found]:
    controller = SETTINGS.model_dump(mode="json")
    return loop_points(points, definition, controller, RIG.period_s, load_hz)


def response(points: list[Found], transfer: str) -> npt.NDArray[np.complex128]:
    there = (one.point for one in points if one.point.transfer == transfer)
    return np.array([p.gain * np.exp(1j * np.radians(p.phase_deg)) for p in there])


def closed(points: list[Found], loop: npt.NDArray[np.complex128]) -> npt.NDArray[np.complex128]:
    """Force to setpoint as this loop has it: (C + C_ff) P/(1 + L), with the plant of the same points."""
    gains, hz = to_record(SETTINGS), [p.point.frequency_hz for p in points]
    at = [shift(f, RIG.period_s) for f in hz[: len(loop)]]
    forward = [
        pid_response(gains, z, RIG.period_s) + feed_forward_response(gains, z, RIG.period_s)
        for z in at
    ]
    return np.asarray(np.array(forward) * response(points, "plant") / (1 + loop))


@pytest.mark.parametrize(
    ("block", "compensation"), [(STEPPED, "auto"), (MULTISINE, "auto"), (MULTISINE, "on")]
)
def test_the_loop_closes_to_the_closed_loop_that_was_measured(
    block: dict[str, Any], compensation: str
) -> None:
    definition, points = found(block, compensation)
    loop = looped(definition, points)
    of_force = [one for one in points if one.point.transfer == "force"]
    assert [one.point.frequency_hz for one in loop] == [p.point.frequency_hz for p in of_force]
    at_loop = [*loop, *(p for p in points if p.point.transfer == "plant")]
    expected = closed(at_loop, response(loop, "loop"))
    assert response(points, "force") == pytest.approx(expected, rel=0.01)
    assert "loop" in available_of(points)


def test_its_margins_are_told_with_intervals_and_change_under_a_load_that_is_compensated() -> None:
    definition, points = found(STEPPED)
    plain, loaded = (looped(definition, points, load_hz) for load_hz in (None, FREQUENCIES[3]))
    margins, under_load = (loop_margins(series_of(one, "loop"))[0] for one in (plain, loaded))
    assert margins.crossover_hz == pytest.approx(48.0, abs=4.0)
    assert margins.phase_margin_deg is not None
    assert under_load.phase_margin_deg is not None
    assert under_load.phase_margin_deg < margins.phase_margin_deg - 2
    assert margins.gain_margin_db == pytest.approx(10.0, abs=1.5)
    assert margins.worst_sensitivity == pytest.approx(1.5, abs=0.15)
    # The notch of a load at this frequency takes the compensation out of the loop there, and there alone.
    assert response(loaded, "loop")[3] == pytest.approx(response(plain, "loop")[3], rel=1e-6)
    assert abs(response(loaded, "loop")[4] / response(plain, "loop")[4] - 1) > 0.02
    for one in plain:
        low, high = one.point.gain_95
        assert 0 < low < one.point.gain < high < 1.05 * one.point.gain


def test_settings_that_cannot_be_read_any_more_have_no_loop() -> None:
    definition, points = found(STEPPED)
    assert loop_points(points, definition, {"k_p": "old"}, RIG.period_s) == []
    assert available_of([]) == ["force"]


def test_where_no_coherence_is_known_that_of_the_loop_is_not_either() -> None:
    definition, points = found(STEPPED)
    unknown = [
        one._replace(point=one.point._replace(coherence=None))
        if one.point.transfer == "motion"
        else one
        for one in points
    ]
    loaded = looped(definition, unknown, FREQUENCIES[3])
    assert [one.point.coherence for one in loaded] == [None] * len(FREQUENCIES)
    assert all(one.point.coherence for one in looped(definition, unknown))
