"""The shipped tests run to their end on the shipped rig and pass; nothing trips that need not."""

from typing import Any

import numpy as np
import pytest

from app.analysis.acceptance import Verdict
from app.conducting.score import scores_of
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.library import library, library_text
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.definitions.reading import definition_from, parse_definition
from app.interlocks.defaults import default_interlocks
from app.prediction.setup import Setup
from app.prediction.simulation import Simulation, simulate
from app.recording.outcome import Outcome
from rtcore.rig.parameters import load_rig

IDS = (
    "flight-spectrum",
    "frequency-response-adaptive",
    "frequency-response-multisine",
    "frequency-response-stepped-sine",
    "harmonic-2-kn-50-hz",
    "harmonic-2-kn-50-hz-moving",
    "hold-50-kn",
    "identification",
    "layers-100-hz",
    "step-2-kn",
    "sweep-1-100-hz",
    "time-history-gust",
    "unit-position-response",
    "unit-slow-cycles",
)
LASTS_AT_MOST_S = dict.fromkeys(IDS, 60.0) | {"identification": 600.0}


def _simulated(definition: Definition) -> Simulation:
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks())
    simulation = simulate(setup)
    assert isinstance(simulation, Simulation), simulation.detail
    return simulation


def _of(*blocks: dict[str, Any], motion: Any = ()) -> Definition:
    data = {"schema": 1, "name": "made up", "blocks": list(blocks), "motion": list(motion)}
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    return definition


def test_the_library_holds_the_paper_s_tests_and_one_of_each_kind() -> None:
    assert tuple(library()) == IDS
    for test_id, definition in library().items():
        assert parse_definition(library_text(test_id)) == definition
        longest_s = outline(definition).duration_s
        if not scores_of(
            definition
        ):  # what adapts is told at its longest, and how long it is below
            assert 1 < longest_s < LASTS_AT_MOST_S[test_id]
    with pytest.raises(KeyError):
        library_text("../__init__")


@pytest.mark.parametrize("test_id", IDS)
def test_every_library_test_passes_on_the_shipped_rig(test_id: str) -> None:
    simulation = _simulated(library()[test_id])
    assert simulation.run.ending.outcome is Outcome.COMPLETED, simulation.run.ending.reason
    assert simulation.judged.verdict is Verdict.PASS, simulation.judged.criteria
    assert 1 < len(simulation.run.records) * RIG.period_s < LASTS_AT_MOST_S[test_id]


def test_the_unit_moves_by_two_millimetres_while_the_load_is_on() -> None:
    simulation = _simulated(library()["harmonic-2-kn-50-hz-moving"])
    records = simulation.run.records
    loaded = records[(records["block"] == 1) & (records["cycle"] > 0)]
    displacement_m = loaded["displacement_m"]
    assert displacement_m.max() == pytest.approx(0.002, rel=1e-3)
    assert displacement_m.min() == pytest.approx(-0.002, rel=1e-3)


def test_compensation_reduces_what_the_motion_does_to_the_force() -> None:
    errors = {}
    for compensation in ("auto", "off"):
        definition = library()["harmonic-2-kn-50-hz-moving"]
        chosen = definition.controller.model_copy(update={"compensation": compensation})
        changed = definition.model_copy(update={"controller": chosen})
        still = changed.model_copy(update={"motion": ()})
        moved = _simulated(changed).run.records["force_n"].astype(np.float64)
        unmoved = _simulated(still).run.records["force_n"].astype(np.float64)
        steady = slice(2 * 4000, 4 * 4000)
        errors[compensation] = float(np.sqrt(np.mean((moved - unmoved)[steady] ** 2)))
    # data sheet, section 5: 303 N rms without compensation, 108 N tuned at 4 Hz
    assert errors["off"] == pytest.approx(303, rel=0.1)
    assert errors["auto"] == pytest.approx(108, rel=0.15)


@pytest.mark.parametrize(
    "blocks",
    [
        [{"kind": "step", "to_n": 30e3, "hold_s": 0.3}, {"kind": "step", "to_n": 0, "hold_s": 0.3}],
        [
            {"kind": "step", "to_n": 30e3, "hold_s": 0.3},
            {"kind": "step", "to_n": -30e3, "hold_s": 0.3},
        ],
        [{"kind": "harmonic", "amplitude_n": 25e3, "frequency_hz": 100, "cycles": 50}],
        [{"kind": "harmonic", "amplitude_n": 30e3, "frequency_hz": 75, "cycles": 50}],
    ],
)
def test_what_the_rig_can_do_trips_nothing(blocks: list[dict[str, Any]]) -> None:
    simulation = _simulated(_of(*blocks))
    assert simulation.run.ending.outcome is Outcome.COMPLETED, simulation.run.ending.reason


def test_the_fastest_motion_under_load_trips_nothing() -> None:
    load = {"kind": "harmonic", "amplitude_n": 20e3, "frequency_hz": 50, "cycles": 100}
    motion = {"kind": "harmonic", "amplitude_m": 0.0079, "frequency_hz": 4, "cycles": 8}
    simulation = _simulated(_of(load, motion=[motion]))
    assert simulation.run.ending.outcome is Outcome.COMPLETED, simulation.run.ending.reason


def test_a_force_that_cannot_be_followed_trips() -> None:
    load = {"kind": "harmonic", "amplitude_n": 50e3, "frequency_hz": 50, "cycles": 50}
    simulation = _simulated(_of(load))
    assert simulation.run.ending.outcome is Outcome.TRIPPED


def test_progress_runs_from_the_beginning_to_the_end() -> None:
    shares: list[float] = []
    definition = library()["step-2-kn"]
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks())
    simulate(setup, shares.append)
    assert shares == sorted(shares)
    assert len(shares) > 3
    assert shares[-1] == 1.0
