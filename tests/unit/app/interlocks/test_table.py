"""The table of detectors: the shipped one is armed as it should be, and the loop adopts it."""

import numpy as np
import pytest

from app.documents.refusal import Problem
from app.documents.writing import to_data
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import describe, interlocks_from, to_record
from app.interlocks.table import Detector, Interlocks
from rtcore.interlocks import Action, Comparison, Quantity, interlocks_are_valid
from rtcore.memory.layout import EVENT
from rtcore.modes import Mode, is_pressurised

PERIOD_S = 250e-6
GOOD = {
    "name": "force",
    "quantity": "force_n",
    "comparison": "magnitude_above",
    "threshold": 55e3,
    "action": "shutdown",
    "armed": ["running"],
}


def _by_name() -> dict[str, Detector]:
    return {detector.name: detector for detector in default_interlocks().detectors}


def test_the_loop_adopts_the_shipped_table() -> None:
    record = to_record(default_interlocks(), PERIOD_S)
    assert interlocks_are_valid(record.reshape(1)[0])
    watched = set(record["detectors"]["quantity"][: record["count"]].tolist())
    assert watched == {int(quantity) for quantity in Quantity}


@pytest.mark.parametrize(
    ("name", "threshold", "ticks", "action"),
    [
        ("force", 55e3, 1, Action.SHUTDOWN),
        ("force_error", 15e3, 200, Action.STOP),
        ("displacement", 0.032, 1, Action.STOP),
        ("velocity", 0.4, 40, Action.STOP),
        ("sensor_faults", 0.5, 1, Action.SHUTDOWN),
        ("supply_pressure", 15e6, 200, Action.STOP),
        ("slow_pressure", 19e6, 60_000, Action.SHUTDOWN),
        ("app_silence", 0.5, 1, Action.STOP),
        ("deadlines_missed", 40, 1, Action.STOP),
    ],
)
def test_the_shipped_detectors_reach_the_loop(
    name: str, threshold: float, ticks: int, action: Action
) -> None:
    place = list(_by_name()).index(name)
    detector = to_record(default_interlocks(), PERIOD_S)["detectors"][place]
    assert detector["threshold"] == threshold
    assert detector["persistence_ticks"] == ticks
    assert detector["action"] == action
    assert detector["enabled"] == 1


def test_detectors_are_armed_where_they_mean_something() -> None:
    pressurised = {mode for mode in Mode if is_pressurised(mode)}
    in_a_test = {Mode.RUNNING, Mode.HOLDING}
    expected = {
        "force_error": in_a_test,
        "supply_pressure": in_a_test | {Mode.READY},
        "slow_pressure": {Mode.PRESSURISING},
        "sensor_faults": set(Mode),  # a dead sensor blocks the reset too
    }
    table = to_record(default_interlocks(), PERIOD_S)
    for place, name in enumerate(_by_name()):
        armed = int(table["detectors"][place]["armed_modes"])
        modes = {mode for mode in Mode if armed >> mode & 1}
        assert modes == expected.get(name, pressurised), name


def test_a_table_survives_being_written_in_words() -> None:
    table = default_interlocks()
    data = to_data(table)
    assert data["detectors"][0]["quantity"] == "force_n"
    assert data["detectors"][0]["armed"] == [m.name.lower() for m in Mode if is_pressurised(m)]
    assert interlocks_from(data) == table


@pytest.mark.parametrize(
    ("changed", "path", "says"),
    [
        ({"quantity": "force"}, "detectors[0].quantity", "did you mean force_n?"),
        ({"armed": []}, "detectors[0].armed", "at least 1 entry"),
        ({"armed": ["runing"]}, "detectors[0].armed[0]", "did you mean running?"),
        ({"threshold": float("nan")}, "detectors[0].threshold", "must be finite"),
        ({"treshold": 1}, "detectors[0].treshold", "did you mean threshold?"),
        ({"persistence_s": -1}, "detectors[0].persistence_s", "at least 0 s"),
    ],
)
def test_what_means_nothing_is_refused(changed: dict[str, object], path: str, says: str) -> None:
    refusal = interlocks_from({"detectors": [GOOD | changed]})
    assert isinstance(refusal, Refusal)
    (problem,) = refusal.faults
    assert isinstance(problem, Problem)
    assert problem.path == path
    assert says in problem.expected


def test_two_detectors_of_one_name_cannot_be_told_apart() -> None:
    refusal = interlocks_from({"detectors": [GOOD, GOOD]})
    assert isinstance(refusal, Refusal)
    assert "two detectors are named force" in refusal.detail


def test_a_trip_is_told_with_its_value_and_its_limit() -> None:
    table = Interlocks(
        detectors=(
            Detector(
                name="force_error",
                quantity=Quantity.FORCE_ERROR_N,
                comparison=Comparison.MAGNITUDE_ABOVE,
                threshold=15e3,
                persistence_s=0.05,
                action=Action.STOP,
                armed=(Mode.RUNNING,),
            ),
        )
    )
    event = np.zeros((), EVENT)
    event["code"], event["value"], event["limit"] = 0, -16_200.4, 15e3
    told = describe(table, event, PERIOD_S)
    assert told == "Force error 16,200 N for 50 ms, limit 15,000 N"
