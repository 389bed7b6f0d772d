"""A planted set of unsafe tests, each refused, and of safe ones, none of which is."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pytest

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.reading import definition_from
from app.interlocks.defaults import default_interlocks
from app.prediction.predicting import Predicted, predict
from app.prediction.schemas import PredictionVerdict
from app.prediction.setup import Setup
from rtcore.rig.parameters import load_rig, rig_from

Item = dict[str, Any]


class Case(NamedTuple):
    """A test, and what of the rig's settings is not as shipped."""

    what: str
    blocks: list[Item]
    motion: Sequence[Item] = ()
    controller: Item | None = None
    rig: Item | None = None


def _sine(amplitude_n: float, hz: float, **more: Any) -> Item:
    return {"kind": "harmonic", "amplitude_n": amplitude_n, "frequency_hz": hz, "cycles": 20} | more


def _step(to_n: float, **more: Any) -> Item:
    return {"kind": "step", "to_n": to_n, "hold_s": 0.3} | more


def _sweep(amplitude_n: float, from_hz: float, to_hz: float, **more: Any) -> Item:
    shape = {"amplitude_n": amplitude_n, "from_hz": from_hz, "to_hz": to_hz, "duration_s": 4.0}
    return {"kind": "sweep"} | shape | more


def _history(amplitude_n: float, hz: float, rate_hz: float = 2000.0, seconds: float = 1.0) -> Item:
    """A burst of a sine under a window, as samples."""
    t = np.arange(round(seconds * rate_hz)) / rate_hz
    samples = amplitude_n * np.sin(np.pi * t / seconds) ** 2 * np.sin(2 * np.pi * hz * t)
    return {"kind": "time_history", "samples_n": samples.tolist(), "rate_hz": rate_hz}


def _swing(amplitude_m: float, hz: float, **more: Any) -> Item:
    shape = {"amplitude_m": amplitude_m, "frequency_hz": hz, "duration_s": 2.0}
    return {"kind": "harmonic"} | shape | more


HOLD: Item = {"kind": "hold", "duration_s": 2.0}

UNSAFE = [
    Case("rated load at 60 Hz", [_sine(49e3, 60)]),
    Case("rated load at 75 Hz", [_sine(49e3, 75)]),
    Case("40 kN at 100 Hz: the valve cannot keep up", [_sine(40e3, 100)]),
    Case("30 kN at 125 Hz", [_sine(30e3, 125)]),
    Case("25 kN at 150 Hz", [_sine(25e3, 150)]),
    Case("30 kN at 200 Hz", [_sine(30e3, 200)]),
    Case("45 kN where the closed loop is at its peak", [_sine(49e3, 40)]),
    Case("a step through the whole range", [_step(50e3), _step(-50e3)]),
    Case("steps to and fro at 45 kN", [_step(45e3, hold_s=0.1), _step(-45e3, hold_s=0.1)]),
    Case("25 kN at 125 Hz about a mean", [_sine(25e3, 125, mean_n=10e3)]),
    Case("a sweep through the resonance of the closed loop", [_sweep(49e3, 10, 80)]),
    Case("a sweep beyond what the valve can follow", [_sweep(30e3, 60, 200)]),
    Case("a sweep downwards through the same", [_sweep(49e3, 80, 10)]),
    Case(
        "a time history that saturates the valve",
        [_history(25e3, 12)],
        rig={"servovalve": {"window_m": 2.3e-3}},
    ),
    Case(
        "a time history under a valve that is held back",
        [_history(20e3, 12)],
        controller={"valve_limit": 0.05},
    ),
    Case(
        "a spectrum with one layer too much",
        [
            {
                "kind": "layers",
                "transition_s": 0.3,
                "repeats": 2,
                "layers": [
                    {"amplitude_n": 5e3, "frequency_hz": 100, "cycles": 50},
                    {"amplitude_n": 40e3, "frequency_hz": 100, "cycles": 50},
                ],
            }
        ],
    ),
    Case(
        "the third amplitude of a frequency response",
        [
            {
                "kind": "frequency_response",
                "amplitudes_n": [2e3, 10e3, 40e3],
                "frequencies_hz": [20, 60, 110],
                "settle_cycles": 3,
                "measure_cycles": 10,
            }
        ],
    ),
    Case("gains that make the loop unstable", [_step(1e3)], controller={"k_p": 5e-4}),
    Case(
        "a valve that is limited to a tenth", [_sine(10e3, 60)], controller={"valve_limit": 0.1}
    ),
    Case(
        "a supply that does not come up", [_sine(1e3, 10)], rig={"supply": {"high_pa": 10e6}}
    ),
    Case(
        "a pump behind too thin a line",
        [_sine(20e3, 75, cycles=300)],
        rig={"supply": {"line_supply_k": 6e13, "accumulator_supply_m3": 1e-4}},
    ),
    Case(
        "a unit that shakes the loaded rig",
        [_sine(48e3, 20, cycles=40)],
        motion=[_swing(0.0079, 4)],
    ),
    Case(
        "a unit that is driven beyond its stops",
        [HOLD],
        motion=[_swing(0.0299, 1.0)],
        rig={"unit": {"stroke_m": 0.02}},
    ),
]  # fmt: skip

SAFE = [
    *(Case(f"{a / 1e3:g} kN at {hz} Hz", [_sine(a, hz)]) for a in (5e3, 20e3) for hz in (1, 10, 50)),
    *(Case(f"{a / 1e3:g} kN at 100 Hz", [_sine(a, 100)]) for a in (5e3, 10e3, 20e3)),
    *(Case(f"a step of {a / 1e3:g} kN", [_step(a)]) for a in (-2e3, 10e3, 30e3)),
    Case("a step through zero", [_step(30e3), _step(-30e3)]),
    Case("the rated load, held", [{"kind": "ramp", "to_n": 50e3, "rate_n_s": 50e3}, HOLD]),
    Case("a sweep at a fifth of the load", [_sweep(5e3, 1, 100)]),
    Case("a sweep downwards", [_sweep(5e3, 100, 1)]),
    Case("a time history of a gust", [_history(10e3, 8, 500.0)]),
    Case("a fast time history, but small", [_history(3e3, 100)]),
    Case("the unit moving under no load", [HOLD], motion=[_swing(0.0079, 4)]),
    Case("the unit moving under load", [_sine(20e3, 50, cycles=100)], motion=[_swing(0.005, 4)]),
    Case("half an hour of load", [_sine(5e3, 50, cycles=90_000)]),
    Case("a valve limited to a half", [_sine(5e3, 50)], controller={"valve_limit": 0.5}),
]  # fmt: skip


def _predict(case: Case) -> Predicted:
    data = {"schema": 1, "name": case.what, "blocks": case.blocks, "motion": list(case.motion)}
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    controller = ControllerSettings.model_validate(case.controller or {})
    rig = rig_from(case.rig) if case.rig else load_rig()
    return predict(Setup(definition, rig, controller, default_interlocks()))


def test_there_are_twenty_of_each_at_least() -> None:
    assert len(UNSAFE) >= 20
    assert len(SAFE) >= 20


@pytest.mark.parametrize("case", UNSAFE, ids=lambda case: case.what)
def test_what_is_unsafe_is_refused(case: Case) -> None:
    prediction = _predict(case).prediction
    assert prediction.verdict is PredictionVerdict.REFUSED, prediction.margins
    assert prediction.reasons[0].severity == "refused"


@pytest.mark.parametrize("case", SAFE, ids=lambda case: case.what)
def test_what_is_safe_is_not(case: Case) -> None:
    prediction = _predict(case).prediction
    assert prediction.verdict is not PredictionVerdict.REFUSED, prediction.reasons


@pytest.mark.parametrize("test_id", library())
def test_the_tests_that_ship_are_clear(test_id: str) -> None:
    setup = Setup(library()[test_id], load_rig(), ControllerSettings(), default_interlocks())
    prediction = predict(setup).prediction
    assert prediction.verdict is PredictionVerdict.CLEAR, prediction.reasons
