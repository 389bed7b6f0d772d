"""Each prediction is computed once, kept for who asks again, and given up only with the console."""

import threading
from typing import Any

import pytest

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.prediction import service
from app.prediction.key import key_of
from app.prediction.play import Progress
from app.prediction.predicting import Predicted
from app.prediction.schemas import Computing
from app.prediction.service import Predictions
from app.prediction.setup import Setup
from rtcore.rig.parameters import load_rig
from tests.a_prediction import a_prediction

PATIENCE_S = 30.0


def _definition(force_n: float = 0.0) -> Definition:
    blocks = [{"kind": "hold", "force_n": force_n, "duration_s": 0.1}]
    found = definition_from({"schema": 1, "name": "hold", "blocks": blocks})
    assert isinstance(found, Definition)
    return found


def _setup(force_n: float) -> Setup:
    return Setup(_definition(force_n), load_rig(), ControllerSettings(), default_interlocks())


class Computer:
    """Stands for the computation: goes on when it is let, and counts how often it was asked."""

    def __init__(self) -> None:
        self.asked: list[float] = []
        self.goes_on = threading.Event()
        self.half_way = threading.Event()

    def __call__(self, setup: Setup, progress: Progress) -> Predicted:
        self.asked.append(setup.definition.blocks[0].force_n)  # type: ignore[union-attr,arg-type]
        progress(0.5)
        self.half_way.set()
        assert self.goes_on.wait(PATIENCE_S)
        progress(1.0)
        return a_prediction(key_of(setup))


@pytest.fixture
def computer() -> Computer:
    return Computer()


@pytest.fixture
def predictions(computer: Computer) -> Any:
    made = Predictions(ControllerSettings(), default_interlocks(), load_rig(), computer)
    yield made
    computer.goes_on.set()
    made.close()


def test_who_does_not_wait_is_told_how_far_it_is(
    predictions: Predictions, computer: Computer
) -> None:
    first = predictions.of(_definition(), 0.0)
    assert isinstance(first, Computing)
    assert computer.half_way.wait(PATIENCE_S)
    then = predictions.of(_definition(), 0.0)
    assert isinstance(then, Computing)
    assert then.share == 0.5
    assert then.seconds_left is not None
    computer.goes_on.set()
    assert isinstance(predictions.of(_definition(), PATIENCE_S), Predicted)
    assert len(computer.asked) == 1


def test_the_same_is_joined_and_then_known(predictions: Predictions, computer: Computer) -> None:
    found: list[Any] = []
    askers = [
        threading.Thread(target=lambda: found.append(predictions.of(_definition(), PATIENCE_S)))
        for _ in range(5)
    ]
    for asker in askers:
        asker.start()
    assert computer.half_way.wait(PATIENCE_S)
    computer.goes_on.set()
    for asker in askers:
        asker.join(PATIENCE_S)
    assert len(computer.asked) == 1
    assert all(one is found[0] for one in found)
    assert predictions.of(_definition(), 0.0) is found[0]


def test_another_test_cancels_nothing(predictions: Predictions, computer: Computer) -> None:
    predictions.of(_definition(100.0), 0.0)
    predictions.of(_definition(200.0), 0.0)
    computer.goes_on.set()
    for force_n in (100.0, 200.0):
        found = predictions.of(_definition(force_n), PATIENCE_S)
        assert isinstance(found, Predicted)
        assert found.prediction.key == key_of(_setup(force_n))
    assert sorted(computer.asked) == [100.0, 200.0]


def test_drafts_do_not_hold_up_what_may_be_started(
    predictions: Predictions, computer: Computer
) -> None:
    for force_n in (1.0, 2.0, 3.0, 4.0):
        predictions.of(_definition(force_n), 0.0, draft=True)
    assert computer.half_way.wait(PATIENCE_S)
    computer.half_way.clear()
    predictions.of(_definition(100.0), 0.0)
    assert computer.half_way.wait(PATIENCE_S)
    assert 100.0 in computer.asked
    assert len(computer.asked) == 2


def test_what_is_kept_is_bounded_and_the_oldest_goes_first(
    predictions: Predictions, computer: Computer, monkeypatch: pytest.MonkeyPatch
) -> None:
    computer.goes_on.set()
    one = predictions.of(_definition(1.0), PATIENCE_S)
    assert isinstance(one, Predicted)
    monkeypatch.setattr(service, "MOST_KEPT_BYTES", 2 * one.nbytes + 1)
    for force_n in (2.0, 1.0, 3.0):
        predictions.of(_definition(force_n), PATIENCE_S)
    assert computer.asked == [1.0, 2.0, 3.0]
    predictions.of(_definition(1.0), PATIENCE_S)  # asked for since
    predictions.of(_definition(2.0), PATIENCE_S)  # the oldest had gone
    assert computer.asked == [1.0, 2.0, 3.0, 2.0]


def test_the_end_of_the_console_ends_it_and_whoever_waits_is_told(computer: Computer) -> None:
    predictions = Predictions(ControllerSettings(), default_interlocks(), load_rig(), computer)
    found: list[Any] = []
    asker = threading.Thread(target=lambda: found.append(predictions.of(_definition(), PATIENCE_S)))
    asker.start()
    assert computer.half_way.wait(PATIENCE_S)
    ending = threading.Thread(target=predictions.close)
    ending.start()
    while not predictions._ending.is_set():
        pass
    computer.goes_on.set()
    ending.join(PATIENCE_S)
    asker.join(PATIENCE_S)
    (refusal,) = found
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.BUSY
    assert isinstance(predictions.of(_definition(), 0.0), Refusal)


def test_a_computation_that_fails_is_not_kept(predictions: Predictions) -> None:
    calls: list[int] = []

    def fails(setup: Setup, progress: Progress) -> Predicted:
        calls.append(1)
        raise ZeroDivisionError

    failing = Predictions(ControllerSettings(), default_interlocks(), load_rig(), fails)
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            failing.of(_definition(), PATIENCE_S)
    assert len(calls) == 2
    failing.close()
