"""The estimators on what the very tick records of the simulated rig, noise and steps of the converters included."""

import numpy as np
import pytest

from app.analysis.response.stepped import SteppedSine
from app.analysis.response.transfers import TRANSFERS
from app.analysis.walk import Walk
from app.definitions.windows import stretches, windows
from bench.recorded import begin, make_test, ready_rig
from rtcore.rig.parameters import load_rig
from rtcore.virtual import PERIOD_S

RIG = load_rig()


def test_dynamic_stiffness_is_that_of_the_parameters() -> None:
    block = {
        "kind": "frequency_response",
        "amplitudes_n": [5000.0],
        "frequencies_hz": [35.0, 100.0],
        "settle_cycles": 6,
        "measure_cycles": 20,
    }
    definition = make_test([block])
    virtual = ready_rig(RIG)
    begin(virtual, definition)
    first_tick = virtual.tick - 1
    records = virtual.advance(windows(definition, 1 << 40).ticks - 1)
    stepped = SteppedSine(PERIOD_S, {"force": TRANSFERS["force"]}, RIG)
    for part in Walk(stretches(definition), PERIOD_S, first_tick).take(records):
        stepped.take(part)
    found = [p for p in stepped.points() if p.transfer == "stiffness"]
    assert [p.frequency_hz for p in found] == [35.0, 100.0]
    for p in found:
        true = RIG.unit.k_tra + 2j * np.pi * p.frequency_hz * RIG.unit.c_tra
        assert p.gain == pytest.approx(abs(true), rel=0.01)
        assert p.phase_deg == pytest.approx(np.degrees(np.angle(true)), abs=1)
