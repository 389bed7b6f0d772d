"""The document: what it takes, what it refuses and where, and what its calibrations and limits say."""

from datetime import UTC, date, datetime
from typing import Any

import pytest

from app.definitions.library import library
from app.definitions.outline import outline
from app.errors import Code, Refusal
from app.revisions.difference import difference
from app.revisions.kind import Revision
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.due import CalibrationWord, calibration_states
from app.rig_configuration.limits import why_not
from app.rig_configuration.record import configuration_from, configuration_of, frozen, model_of
from rtcore.rig.parameters import load_rig

TODAY = date(2026, 6, 1)


def configured(**parts: Any) -> RigConfiguration:
    found = configuration_from(parts)
    assert isinstance(found, RigConfiguration), found
    return found


def in_force(document: RigConfiguration) -> Revision[RigConfiguration]:
    return Revision(3, document, "Ann", "New cell", datetime(2026, 6, 1, tzinfo=UTC))


def test_what_is_left_out_is_as_shipped_in_the_model_too() -> None:
    found = configured(model={"structure": {"k_pl": 140e6}})
    assert found.model.structure.k_pl == 140e6
    assert found.model.structure.k_lc == load_rig().structure.k_lc
    changes = difference(RigConfiguration(), found, (0, 1)).changes
    assert [(c.path, c.before, c.after) for c in changes] == [
        ("model.structure.k_pl", 150e6, 140e6)
    ]


@pytest.mark.parametrize(
    ("parts", "path"),
    [
        ({"calibrations": {"load_cel": {"gain": 1.0}}}, "calibrations.load_cel"),
        ({"calibrations": {"load_cell": {"gain": 0.0}}}, "calibrations.load_cell.gain"),
        ({"calibrations": {"lvt": {"gain": 1, "due_on": "2026-01-01"}}}, "calibrations.lvt.due_on"),
        ({"model": {"structure": {"k_pl": -1.0}}}, "model.structure.k_pl"),
        ({"model": {"structure": {"k_p": 1.0}}}, "model.structure.k_p"),
        ({"limits": {"force_n": 60e3}}, "limits.force_n"),
        ({"lab": "x" * 201}, "lab"),
        ({"unit": {}}, "unit"),
    ],
)
def test_what_is_wrong_is_refused_by_its_path(parts: dict[str, Any], path: str) -> None:
    found = configuration_from(parts)
    assert isinstance(found, Refusal)
    assert [fault.path for fault in found.faults] == [path]


@pytest.mark.parametrize(
    ("calibrated", "due", "word", "text"),
    [
        (None, None, CalibrationWord.NONE, "no calibration entered"),
        ("2025-01-10", None, CalibrationWord.VALID, "calibrated on 2025-01-10, never due again"),
        ("2025-01-10", "2026-05-31", CalibrationWord.OVERDUE, "overdue since 2026-05-31"),
        ("2025-01-10", "2026-06-01", CalibrationWord.DUE_SOON, "due on 2026-06-01"),
        ("2025-01-10", "2026-07-02", CalibrationWord.VALID, "valid until 2026-07-02"),
    ],
)
def test_a_calibration_says_whether_it_holds(
    calibrated: str | None, due: str | None, word: CalibrationWord, text: str
) -> None:
    cell = {"gain": 6e3, "calibrated_on": calibrated, "due_on": due}
    states = calibration_states(configured(calibrations={"load_cell": cell}).calibrations, TODAY)
    assert (states[0].sensor, states[0].word, states[0].text) == ("load_cell", word, text)
    assert len(states) == 6


def test_the_labs_own_limits_stand_against_a_test_that_goes_beyond_them() -> None:
    plan = outline(library()["hold-50-kn"])
    assert why_not(plan, in_force(RigConfiguration())) is None
    refusal = why_not(plan, in_force(configured(limits={"force_n": 40e3})))
    assert refusal is not None
    assert refusal.code is Code.INVALID_TEST
    assert "reaches a force of 50,000 N" in refusal.detail
    assert "revision 3 of the rig configuration allows 40,000 N" in refusal.detail


def test_a_run_keeps_the_model_as_it_always_did_and_the_rest_beside_it() -> None:
    document = configured(lab="Lab 4", model={"structure": {"k_pl": 140e6}})
    kept = frozen(in_force(document))
    assert kept["structure"]["k_pl"] == 140e6
    assert (kept["configuration"]["revision"], kept["configuration"]["lab"]) == (3, "Lab 4")
    assert model_of(kept) == document.model
    assert configuration_of(kept) == document
    before = load_rig().model_dump(mode="json")  # as runs had it before there were configurations
    assert (model_of(before), configuration_of(before)) == (load_rig(), None)
