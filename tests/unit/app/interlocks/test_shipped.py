"""The table as shipped: every kind of detector is there, armed as it should be, and the loop adopts it."""

import pytest

from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record
from app.interlocks.table import Detector
from rtcore.interlocks import Action, Form, Quantity, interlocks_are_valid
from rtcore.modes import Mode, is_pressurised

PERIOD_S = 250e-6
BY_NAME = {detector.name: detector for detector in default_interlocks().detectors}
UNWATCHED = {Quantity.VALVE_COMMAND, Quantity.PRESSURE_1_PA, Quantity.PRESSURE_2_PA}
ALWAYS, PRESSURISED = set(Mode), {mode for mode in Mode if is_pressurised(mode)}
LOADED, IN_A_TEST = PRESSURISED - {Mode.PRESSURISING}, {Mode.RUNNING, Mode.HOLDING}


def test_the_loop_adopts_it_and_it_watches_everything_that_can_go_wrong() -> None:
    record = to_record(default_interlocks(), PERIOD_S)
    assert interlocks_are_valid(record.reshape(1)[0])
    watched = {d.quantity for d in BY_NAME.values()}
    assert watched == set(Quantity) - UNWATCHED
    assert {d.form for d in BY_NAME.values()} == set(Form)


@pytest.mark.parametrize(
    ("name", "threshold", "ticks", "action", "armed"),
    [
        ("force", 55e3, 1, Action.SHUTDOWN, PRESSURISED),
        ("force_ahead", 55e3, 1, Action.SHUTDOWN, PRESSURISED),
        ("force_rate", 20e6, 1, Action.SHUTDOWN, LOADED),
        ("force_error", 15e3, 200, Action.STOP, IN_A_TEST),
        ("force_error_relative", 0.5, 1000, Action.INDICATE, {Mode.RUNNING}),
        ("underpeak", 0.3, 4000, Action.INDICATE, {Mode.RUNNING}),
        ("end_of_count", 10e6, 1, Action.INDICATE, {Mode.RUNNING}),
        ("displacement", 0.032, 1, Action.STOP, PRESSURISED),
        ("displacement_ahead", 0.033, 1, Action.STOP, PRESSURISED),
        ("displacement_error", 8e-3, 800, Action.STOP, IN_A_TEST),
        ("velocity", 0.4, 40, Action.STOP, PRESSURISED),
        ("load_cell", 0.5, 1, Action.SHUTDOWN, ALWAYS),
        ("lvt", 0.5, 1, Action.SHUTDOWN, ALWAYS),
        ("lvdt", 0.5, 1, Action.STOP, ALWAYS),
        ("pressure_sensor", 0.5, 1, Action.STOP, ALWAYS),
        ("stop_error", 10e3, 400, Action.SHUTDOWN, {Mode.STOPPING}),
        ("valve_spool", 0.15, 20, Action.SHUTDOWN, LOADED),
        ("twin_residual", 5e3, 200, Action.STOP, IN_A_TEST),
        ("twin_goodness", 70.0, 4000, Action.INDICATE, {Mode.RUNNING}),
        ("supply_pressure", 15e6, 200, Action.STOP, IN_A_TEST | {Mode.READY}),
        ("slow_pressure", 19e6, 60_000, Action.SHUTDOWN, {Mode.PRESSURISING}),
        ("valve_saturation", 0.9, 400, Action.STOP, IN_A_TEST),
        ("app_silence", 0.5, 1, Action.STOP, PRESSURISED),
        ("deadlines_missed", 40, 1, Action.STOP, PRESSURISED),
        ("storage", 10.0, 1, Action.STOP, IN_A_TEST),
        ("hard_wired_chain", 0.5, 1, Action.SHUTDOWN, ALWAYS),
    ],
)
def test_each_reaches_the_loop(
    name: str, threshold: float, ticks: int, action: Action, armed: set[Mode]
) -> None:
    place = list(BY_NAME).index(name)
    detector = to_record(default_interlocks(), PERIOD_S)["detectors"][place]
    assert detector["threshold"] == threshold
    assert detector["persistence_ticks"] == ticks
    assert detector["action"] == action
    assert {mode for mode in Mode if int(detector["armed_modes"]) >> mode & 1} == armed
    assert detector["enabled"] == 1


def test_none_is_left_out_above() -> None:
    assert len(BY_NAME) == 26


@pytest.mark.parametrize("detector", BY_NAME.values(), ids=BY_NAME)
def test_each_says_what_it_means_and_what_to_do(detector: Detector) -> None:
    assert len(detector.text) > 60
    assert detector.text.count(". ") + detector.text.count("? ") + detector.text.count(": ") >= 1
    assert "\n" not in detector.text
