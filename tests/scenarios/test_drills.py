"""Every fault in every situation on the virtual clock: the expected reaction, and peaks within what the rig takes."""

from functools import cache

import numpy as np
import pytest

from app.drills.drills import DRILLS, Drill
from bench.drills import END_STOP_M, Given, Situation, give, situations
from rtcore.rig.faults import Fault

CASES = [
    pytest.param(drill, situation, id=f"{drill.name}-{situation.name}")
    for drill in DRILLS
    for situation in situations()
    if (drill.ready if situation.test is None else drill.test) is not None
]
given = cache(give)


def test_every_fault_has_a_drill() -> None:
    assert [drill.fault for drill in DRILLS] == list(Fault)
    assert all(drill.ready or drill.test for drill in DRILLS)


@pytest.mark.parametrize(("drill", "situation"), CASES)
def test_a_fault_brings_the_expected_reaction_and_no_peak_beyond_the_rig(
    drill: Drill, situation: Situation
) -> None:
    found = given(drill, situation)
    assert isinstance(found, Given)
    assert [e.text for e in found.score.expectations if not e.met] == []
    assert np.all(np.isfinite(found.states))
    # What the sensors tell is judged by the score; these are the plant's own.
    assert abs(found.force_n) < 60e3
    assert abs(found.unit_m) < 0.030
    assert abs(found.stroke_m) < END_STOP_M


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("situation", situations(), ids=lambda s: s.name)
def test_a_valve_hard_over_to_either_side_pushes_no_more_than_the_supply_can(
    situation: Situation, side: float
) -> None:
    found = give(next(d for d in DRILLS if d.fault is Fault.VALVE_HARD_OVER), situation, side)
    assert found is not None
    assert found.score.passed
    assert abs(found.force_n) < 60e3
