"""The position response on the virtual rig is that of the unit's servo, whatever the force does meanwhile."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.analysis.response.unit_under_test import servo
from app.conducting.found import Found
from app.conducting.responding import Responding, responds
from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.runs.response_series import series_of
from bench.recorded import begin, ready_rig
from rtcore.codes import Opcode, Reply
from rtcore.rig.parameters import load_rig
from tests.unit.app.conducting.responses import played

UNIT = load_rig()
LINES = [4.0, 8.0, 12.0, 20.0, 40.0]
RAMP = {"kind": "ramp", "to_n": 5000, "rate_n_s": 50_000}
HOLD = {
    "kind": "hold",
    "duration_s": 3.6,
}  # two realisations of a lead and five quarters of a second
Records = npt.NDArray[Any]


def moved(*blocks: dict[str, Any], **changed: Any) -> Definition:
    """A test with two realisations, each of a period to settle and four that count."""
    motion = {"kind": "multisine", "amplitude_m": 0.0008, "frequencies_hz": LINES}
    motion |= {"realisations": 2, "settle_cycles": 1, "measure_cycles": 4} | changed
    test = {"schema": 1, "name": "moved", "blocks": list(blocks), "motion": [motion]}
    return Definition.model_validate(test)


def positions(definition: Definition, records: Records, chunks: int = 1) -> list[Found]:
    responding = Responding(definition, RIG.period_s)
    for chunk in np.array_split(records, chunks):
        responding.take(chunk)
    return [found for found in responding.points() if found.point.transfer == "position"]


def errors(found: list[Found]) -> tuple[float, float]:
    """Worst against the closed form, in % and degrees."""
    said = [f.point.gain * np.exp(1j * np.radians(f.point.phase_deg)) for f in found]
    apart = np.array(said) / servo(UNIT, np.array([f.point.frequency_hz for f in found]))
    return float(100 * np.abs(np.abs(apart) - 1).max()), float(
        np.abs(np.angle(apart, deg=True)).max()
    )


def test_it_is_the_servo_s_to_100_hz_with_load_off_and_on() -> None:
    definition = library()["unit-position-response"]
    assert responds(definition)
    found = positions(definition, played(definition).records, 100)
    percent, degrees = errors(found)
    assert percent < 1
    assert degrees < 1
    off, on = series_of(found, "position")
    assert (off.block, off.mean_n, off.amplitude_m) == (0, 0.0, 0.001)
    assert (on.block, on.mean_n, on.amplitude_m) == (1, 10_000.0, 0.001)
    assert [p.frequency_hz for p in on.points] == list(definition.motion[1].frequencies_hz)  # type: ignore[union-attr]
    for extremes in (off.extremes, on.extremes):
        assert extremes.minus_90_deg_hz == pytest.approx(
            12.0, rel=1e-3
        )  # where the servo is natural
        down = servo(UNIT, np.array([extremes.minus_3_db_hz]))
        assert np.abs(down) == pytest.approx([np.sqrt(0.5)], rel=5e-3)


def test_the_period_of_a_hold_is_left_out_and_settled_again_after_it() -> None:
    definition = moved(RAMP, HOLD)
    virtual = ready_rig(UNIT)
    begin(virtual, definition)
    first = virtual.block.ring[(virtual.tick - 1) % len(virtual.block.ring)].copy()
    parts = [np.array([first]), virtual.advance(5000)]  # in the third period
    assert virtual.command(Opcode.HOLD, 0) is Reply.ACCEPTED
    parts.append(virtual.advance(2000))
    assert virtual.command(Opcode.RESUME, 0) is Reply.ACCEPTED
    parts.append(virtual.advance(round(outline(definition).duration_s / RIG.period_s)))
    records = np.concatenate(parts)
    found = positions(definition, records[records["run"] == 1], 40)
    assert [f.point.cycles for f in found] == [
        round(hz / 4 * 6) for hz in LINES
    ]  # two fewer of eight
    percent, degrees = errors(found)
    assert percent < 0.3
    assert degrees < 0.2


def test_what_the_force_skips_moves_nothing_of_the_motion() -> None:
    sines = {"kind": "frequency_response", "amplitudes_n": [2000.0], "frequencies_hz": [40.0, 80.0]}
    sure = {"measure_cycles": 150, "confidence": {"gain_db": 0.2, "phase_deg": 2.0}}
    definition = moved(sines | sure, HOLD)
    run = played(definition)
    assert run.skips > 0
    found = positions(definition, run.records)
    assert [f.point.cycles for f in found] == [round(hz / 4 * 8) for hz in LINES]
    percent, degrees = errors(found)
    assert percent < 0.3
    assert degrees < 0.2


def test_a_run_under_way_has_the_whole_periods_so_far() -> None:
    definition = moved(HOLD)
    records = played(definition).records
    lead_ticks, period = round(0.4712389 * 4000), 1000
    counted = lead_ticks + 4 * period
    assert positions(definition, records[: lead_ticks + 2 * period - 1]) == []
    so_far = positions(definition, records[: counted + period - 1])
    assert [f.point.cycles for f in so_far] == [round(hz / 4 * 3) for hz in LINES]
