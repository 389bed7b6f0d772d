"""The margin to a detector is below zero exactly where the loop trips it: hundreds of detectors, one by one."""

from typing import Any

import numpy as np
import pytest

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.interlocks.table import Detector, Interlocks
from app.prediction.play import Play, made_ready
from app.prediction.predicting import predict
from app.prediction.setup import Setup
from rtcore.interlocks import MAX_DETECTORS, Action, Comparison, Form, Quantity
from rtcore.modes import Mode
from rtcore.rig.parameters import load_rig

IN_A_RUN = (Mode.RUNNING, Mode.HOLDING, Mode.STOPPING)
# What each quantity and its rate reach in the tests below, so that a threshold drawn from it is now passed, now not.
RANGES = {
    Quantity.FORCE_N: (12e3, 4e6),
    Quantity.FORCE_ERROR_N: (10e3, 4e6),
    Quantity.DISPLACEMENT_M: (2.2e-3, 0.1),
    Quantity.VELOCITY_M_S: (0.15, 40.0),
}


def _definition(rng: np.random.Generator) -> Definition:
    blocks: list[dict[str, Any]] = [
        {"kind": "step", "to_n": float(rng.uniform(-8e3, 8e3)), "hold_s": 0.05},
        {
            "kind": "harmonic",
            "amplitude_n": float(rng.uniform(1e3, 9e3)),
            "frequency_hz": float(rng.uniform(5, 90)),
            "cycles": 8,
        },
        {"kind": "hold", "force_n": float(rng.uniform(-5e3, 5e3)), "duration_s": 0.2},
    ]
    motion = [{"kind": "harmonic", "amplitude_m": 2e-3, "frequency_hz": 6, "duration_s": 0.5}]
    data = {"schema": 1, "name": "drawn", "blocks": blocks, "motion": motion}
    found = definition_from(data)
    assert isinstance(found, Definition), found.detail
    return found


def _detector(rng: np.random.Generator, number: int) -> Detector:
    quantity = list(RANGES)[int(rng.integers(len(RANGES)))]
    form = Form(int(rng.integers(len(Form))))
    comparison = Comparison(int(rng.integers(len(Comparison))))
    scale = RANGES[quantity][form is Form.RATE] * float(rng.uniform(0.0, 1.0)) ** 2
    return Detector(
        name=f"drawn_{number}",
        quantity=quantity,
        form=form,
        comparison=comparison,
        threshold=-scale if comparison is Comparison.BELOW else scale,
        low=-float(rng.uniform(0.5, 2.0)) * scale - 1e-9
        if comparison is Comparison.OUTSIDE
        else None,
        horizon_s=float(rng.choice([0.0005, 0.004])) if form is Form.LOOK_AHEAD else None,
        smoothing_s=float(rng.choice([0.0005, 0.005])) if form is not Form.VALUE else None,
        persistence_s=float(rng.choice([0.0, 0.0005, 0.002, 0.008, 0.04, 0.3])),
        action=Action.INDICATE,
        armed=IN_A_RUN if rng.uniform() < 0.8 else (Mode.RUNNING,),
        enabled=bool(rng.uniform() < 0.95),
    )


def _played(seed: int, detectors: tuple[Detector, ...] | None = None) -> Play:
    rng = np.random.default_rng(seed)
    definition = _definition(rng)
    table = detectors or tuple(_detector(rng, i) for i in range(MAX_DETECTORS))
    setup = Setup(
        definition, load_rig(), ControllerSettings(), Interlocks(detectors=table), seed + 1
    )
    play = made_ready(setup)
    assert isinstance(play, Play), play.detail
    for _ in play.chunks():
        pass
    return play


@pytest.mark.parametrize("seed", range(12))
def test_an_excess_is_above_zero_exactly_where_the_loop_trips(seed: int) -> None:
    play = _played(seed)
    trips = int(play.rig.io.core["trips"])
    tripped = [bool(trips >> i & 1) for i in range(MAX_DETECTORS)]
    predicted = [bool(e["excess"] > 0) for e in play.watch.extremes]
    assert predicted == tripped
    assert 8 < sum(tripped) < 56  # it can tell the one from the other


def test_a_threshold_at_the_very_extreme_does_not_trip_and_the_next_number_below_does() -> None:
    def detector(threshold: float, persistence_s: float) -> Detector:
        return Detector(
            name="force",
            quantity=Quantity.FORCE_N,
            comparison=Comparison.MAGNITUDE_ABOVE,
            threshold=threshold,
            persistence_s=persistence_s,
            action=Action.INDICATE,
            armed=IN_A_RUN,
        )

    for persistence_s in (0.0, 0.002):
        play = _played(3, (detector(1e4, persistence_s),))
        reached = 1e4 + float(play.watch.extremes[0]["excess"])
        while True:  # the sum may have been rounded
            again = _played(3, (detector(reached, persistence_s),))
            excess = float(again.watch.extremes[0]["excess"])
            if excess == 0.0:
                break
            reached += excess
        assert int(again.rig.io.core["trips"]) == 0
        below = float(np.nextafter(reached, 0.0))
        play = _played(3, (detector(below, persistence_s),))
        assert int(play.rig.io.core["trips"]) == 1
        assert play.watch.extremes[0]["excess"] > 0


def test_the_tick_of_an_extreme_is_the_one_in_which_the_loop_trips() -> None:
    play = _played(5)
    for event in play.events:
        if event.kind != "trip":
            continue
        first = play.first_tick
        assert first <= event.tick
        extreme = play.watch.extremes[event.detector]
        # The first time beyond is no later than the time furthest beyond.
        assert event.tick - first <= extreme["tick"]


@pytest.mark.parametrize("armed", [Mode.RUNNING, Mode.STOPPING])
def test_what_is_always_violated_trips_after_as_many_armed_ticks_as_it_must_persist(
    armed: Mode,
) -> None:
    def always(persistence_s: float) -> Detector:
        return Detector(
            name=f"after_{persistence_s * 1e6:.0f}",
            quantity=Quantity.DEADLINES_MISSED,  # there are none on the virtual clock
            comparison=Comparison.BELOW,
            threshold=1.0,
            persistence_s=persistence_s,
            action=Action.INDICATE,
            armed=(armed,),
        )

    spans = (0.0, 0.00125, 0.1, 0.5, 0.50025, 50.0)
    play = _played(3, tuple(always(span) for span in spans))
    events = {e.detector: e.tick for e in play.events if e.kind == "trip"}
    assert set(events) >= {0, 1, 2}
    assert (4 in events) == (armed is Mode.RUNNING)  # the load is taken off in half a second
    for i, extreme in enumerate(play.watch.extremes):
        assert (extreme["excess"] > 0) == (i in events)
        if i in events:
            assert play.first_tick + extreme["tick"] == events[i]


def test_looking_at_a_run_changes_nothing_in_it() -> None:
    setup = _played(7).setup
    watched, bare = made_ready(setup), made_ready(setup)
    assert isinstance(watched, Play)
    assert isinstance(bare, Play)
    seen = np.concatenate(list(watched.chunks()))
    assert np.array_equal(seen, bare.rig.run())


def test_cycles_that_were_cut_away_count() -> None:
    block = {"kind": "harmonic", "amplitude_n": 500, "frequency_hz": 20, "cycles": 100_000}
    definition = definition_from({"schema": 1, "name": "long", "blocks": [block]})
    assert isinstance(definition, Definition)
    for threshold, margin in ((99_999.0, -1.0), (100_000.0, 0.0), (123_456.0, 23_456.0)):
        count = Detector(
            name="count",
            quantity=Quantity.CYCLES,
            comparison=Comparison.ABOVE,
            threshold=threshold,
            action=Action.HOLD,
            armed=IN_A_RUN,
        )
        setup = Setup(definition, load_rig(), ControllerSettings(), Interlocks(detectors=(count,)))
        prediction = predict(setup).prediction
        assert prediction.shortened
        (found,) = prediction.margins
        assert found.margin == margin
        assert (prediction.verdict == "refused") == (margin < 0)
