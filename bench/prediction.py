"""How long a prediction of a minute's test takes, and beside it the same minute on the virtual rig alone."""

import time
from collections.abc import Callable, Iterator
from statistics import median
from typing import Any

from app.controller.record import to_record as gains_of
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import parse_definition
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_of
from app.prediction.predicting import predict
from app.prediction.setup import Setup
from bench.report import Figure, progress, show, tracked
from rtcore.codes import Opcode
from rtcore.rig.parameters import load_rig
from rtcore.virtual import Virtual

MINUTE_S = 60.0
AT_MOST_S = 1.0
REPEATS = 7
PERIOD_S = 250e-6
CHUNK_TICKS = 4000

# What each lasts with leads and tapers is told; none is longer than what is predicted whole.
TESTS = {
    "harmonic": """
blocks: [{kind: harmonic, amplitude_n: 2000, frequency_hz: 50, duration_s: 59.5}]
motion: [{kind: harmonic, amplitude_m: 0.002, frequency_hz: 4, duration_s: 59.5}]
""",
    "layers": """
blocks:
  - kind: layers
    transition_s: 0.2
    repeats: 14
    layers:
      - {mean_n: 0, amplitude_n: 5000, frequency_hz: 100, cycles: 100}
      - {mean_n: 10000, amplitude_n: 5000, frequency_hz: 100, cycles: 100}
      - {mean_n: -8000, amplitude_n: 8000, frequency_hz: 50, cycles: 80}
""",
    "sweep": "blocks: [{kind: sweep, amplitude_n: 2000, from_hz: 1, to_hz: 100, duration_s: 57}]\n",
}


def _definition(name: str) -> Definition:
    found = parse_definition(f"schema: 1\nname: A minute of {name}\n{TESTS[name]}", name)
    if isinstance(found, Refusal):
        raise ValueError(found.detail)
    return found


def _alone(setup: Setup, ticks: int) -> float:
    """Seconds that so many ticks take on the virtual rig, with nobody looking."""
    gains, interlocks = gains_of(setup.controller), interlocks_of(setup.interlocks, PERIOD_S)
    rig = Virtual(gains, interlocks, setup.rig, setup.seed, PERIOD_S)
    rig.bring_to_ready()
    rig.load_program(expand(setup.definition))
    rig.command(Opcode.START, 1)
    began = time.perf_counter()
    for _ in range(ticks // CHUNK_TICKS):
        rig.advance(CHUNK_TICKS)
    return time.perf_counter() - began


def measure(name: str) -> Iterator[Figure]:
    """Predicted and bare take turns, so that a disturbance of the machine hits both."""
    setup = Setup(_definition(name), load_rig(), ControllerSettings(), default_interlocks())
    took: dict[str, list[float]] = {"predicted": [], "alone": []}
    predicted_s = 0.0
    predict(setup)  # compiles

    def keep(which: str, work: Callable[[], Any]) -> None:
        began = time.perf_counter()
        work()
        took[which].append(time.perf_counter() - began)

    for _ in tracked(range(REPEATS), f"predicting a minute of {name}"):
        keep("predicted", lambda: predict(setup))
        predicted_s = predict(setup).prediction.predicted_s if predicted_s == 0.0 else predicted_s
        took["alone"].append(_alone(setup, round(predicted_s / PERIOD_S)))
    minutes = predicted_s / MINUTE_S
    best = {which: min(seconds) / minutes for which, seconds in took.items()}
    middle = median(took["predicted"]) / minutes
    yield Figure(
        f"{name}_prediction_s",
        f"{name}: prediction of 60 s, settings to verdict",
        best["predicted"],
        "s",
        at_most=AT_MOST_S,
        note=f"median {middle:.2f} s; {predicted_s:.1f} s predicted whole",
    )
    yield Figure(
        f"{name}_ratio",
        f"{name}: prediction / the virtual rig alone",
        best["predicted"] / best["alone"],
        "×",
        note=f"alone {best['alone']:.2f} s for 60 s",
    )


NOTES = [
    f"best of {REPEATS} repeats, prediction and bare rig in turns, on one core, wall clock",
    "prediction: pressurising, every tick watched, all measurements, verdict; alone: the ticks only",
]


def main(as_json: bool) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    progress("compiling what predicts")
    figures = [figure for name in TESTS for figure in measure(name)]
    show("prediction", figures, NOTES, as_json)
    return 0
