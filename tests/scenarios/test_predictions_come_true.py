"""Fifty drawn tests: what is predicted of each comes true in a run with other noise."""

import pytest

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.prediction.play import Play, made_ready
from app.prediction.predicting import predict
from app.prediction.setup import Setup
from rtcore.rig.parameters import load_rig
from tests.generated_tests import drawn, has_a_sign, indicating

PEAK_WITHIN = 0.01
OTHER_SEED = 4711


def _setup(number: int, seed: int) -> Setup:
    definition = definition_from(drawn(number))
    assert isinstance(definition, Definition), definition.detail
    return Setup(definition, load_rig(), ControllerSettings(), indicating(), seed)


@pytest.mark.parametrize("number", range(50))
def test_peak_and_trips_are_those_predicted(number: int) -> None:
    prediction = predict(_setup(number, 1)).prediction
    assert prediction.shortened == []
    play = made_ready(_setup(number, OTHER_SEED))
    assert isinstance(play, Play)
    for _ in play.chunks():
        pass
    assert prediction.outcome == play.ending.outcome.value
    seen = float(play.watch.seen["force_n"])
    assert prediction.peaks.force_n == pytest.approx(seen, rel=PEAK_WITHIN)
    trips = {event.detector for event in play.events if event.kind == "trip"}
    told = [
        (i, m.margin)
        for i, m in enumerate(prediction.margins)
        if m.margin is not None and has_a_sign(m.quantity, m.margin)
    ]
    assert len(told) >= 15
    assert {i for i, margin in told if margin < 0} == trips & {i for i, _ in told}


def test_the_drawn_tests_tell_one_sign_from_the_other() -> None:
    signs = [
        margin.margin > 0
        for number in range(0, 50, 7)
        for margin in predict(_setup(number, 1)).prediction.margins
        if margin.margin is not None and margin.detector.startswith("shown")
    ]
    assert 0.2 < sum(signs) / len(signs) < 0.8
