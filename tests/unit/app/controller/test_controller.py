"""Controller settings: the shipped ones are the data sheet's, and the loop gets them in its units."""

import math
from pathlib import Path

import pytest

from app.controller.presets import COMPENSATORS
from app.controller.record import controller_from, load_controller, to_record
from app.controller.settings import ControllerSettings
from app.documents.refusal import Problem
from app.documents.writing import to_data
from app.errors import Refusal
from rtcore.control.law import gains_are_valid

TURN = 2 * math.pi


def _settings(data: object) -> ControllerSettings:
    settings = controller_from(data)
    assert isinstance(settings, ControllerSettings), settings.detail
    return settings


def test_the_loop_gets_the_gains_of_the_data_sheet() -> None:
    record = to_record(ControllerSettings())
    expected = {
        "k_p": 1.19e-5,
        "k_i": 0.00438,
        "k_d": 3.39e-8,
        "omega_d_rad_s": 1193.8052083641214,
        "k_ff": 6e-9,
        "valve_limit": 1.0,
        "valve_slew_per_s": math.inf,
        "ff_v": 1.9607,
        "ff_a": 0.010862,
        "lead_zero_rad_s": TURN * 1.0,
        "lead_pole_rad_s": TURN * 3.0,
        "low_pass_rad_s": TURN * 8.0,
        "low_pass_order": 1,
        "notch_damping": 0.15,
        "fade_s": 0.1,
        "compensate": 1,
    }
    assert {name: record[name].item() for name in expected} == pytest.approx(expected)


@pytest.mark.parametrize("name", COMPENSATORS)
def test_every_preset_can_be_named_and_is_adopted_by_the_loop(name: str) -> None:
    settings = _settings({"compensator": name})
    record = to_record(settings)
    assert record["ff_v"] == COMPENSATORS[name]["ff_v"]
    assert record["low_pass_order"] == COMPENSATORS[name]["low_pass_order"]
    assert gains_are_valid(record.reshape(1)[0], 250e-6)
    assert _settings(to_data(settings)) == settings


def test_a_file_changes_what_it_names(tmp_path: Path) -> None:
    path = tmp_path / "controller.yaml"
    path.write_text("k_p: 2.0e-5\nvalve_slew_per_s: 50\ncompensator: COMP8\n")
    settings = load_controller(path)
    assert isinstance(settings, ControllerSettings)
    record = to_record(settings)
    assert (record["k_p"], record["k_i"], record["valve_slew_per_s"]) == (2e-5, 4.38e-3, 50)
    assert record["low_pass_damping"] == 0.7


@pytest.mark.parametrize(
    ("data", "path", "says"),
    [
        ({"kp": 1}, "kp", "did you mean k_p?"),
        ({"k_p": -1}, "k_p", "must be at least 0"),
        ({"derivative_hz": 2000}, "derivative_hz", "2,000 Hz must be below 2,000 Hz"),
        ({"valve_limit": 1.1}, "valve_limit", "must be at most 1"),
        ({"valve_slew_per_s": 0}, "valve_slew_per_s", "0 1/s must be above 0 1/s"),
        ({"compensator": "COMP88"}, "compensator", "did you mean COMP8?"),
        (
            {"compensator": {**COMPENSATORS["COMP4"], "low_pass_order": 2}},
            "compensator.low_pass_damping",
            "order 2 needs low_pass_damping",
        ),
        (
            {"compensator": {**COMPENSATORS["COMP4"], "notch_damping": 0}},
            "compensator.notch_damping",
            "must be above 0",
        ),
    ],
)
def test_settings_out_of_bounds_are_refused(data: object, path: str, says: str) -> None:
    refusal = controller_from(data)
    assert isinstance(refusal, Refusal)
    (problem,) = refusal.faults
    assert isinstance(problem, Problem)
    assert problem.path == path
    assert says in problem.expected
