"""`forcerig bench multisine_time`: a frequency response of 1 to 100 Hz at 1 Hz, all at once and one after another.

Both on the virtual rig with noise, both to the same stated confidence at every frequency: the stepped sine
goes on as soon as a point is sure, the multisine is over with the period after which all of its lines are.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from app.analysis.response.point import ResponsePoint
from app.conducting.conductor import MEASURED
from app.conducting.responding import Responding
from app.controller.settings import ControllerSettings
from app.definitions.adaptive import Confidence
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.interlocks.defaults import default_interlocks
from app.prediction.play import Play, made_ready
from app.prediction.setup import Setup
from bench.report import Figure, show
from rtcore.rig.parameters import load_rig

AMPLITUDE_N = 2000.0
CONFIDENCE = Confidence()
FREQUENCIES_HZ = [float(hz) for hz in range(1, 101)]
MOST_PERIODS, MOST_CYCLES = 60, 60
SHARE = 0.1
NOTES = [
    "one realisation: the intervals of the multisine are of the noise, not of distortion",
    "stepped: 2 cycles to blend, 2 to settle and at least 4 to measure, of each frequency",
]


def _test(**asked: Any) -> Definition:
    block = {
        "kind": "frequency_response",
        "amplitudes_n": [AMPLITUDE_N],
        "frequencies_hz": FREQUENCIES_HZ,
        **asked,
    }
    return Definition.model_validate({"schema": 1, "name": "response", "blocks": [block]})


def _played(definition: Definition) -> Iterator[Any]:
    """The run, (n,) TELEMETRY at a time."""
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks())
    play = made_ready(setup)
    if not isinstance(play, Play):
        raise RuntimeError(play.detail)
    yield from play.chunks()


def _is_within(point: ResponsePoint) -> bool:
    low, high = point.gain_95
    if not low > 0:
        return False
    wide_db = 20 * np.log10(max(high / point.gain, point.gain / low))
    wide_deg = 0.5 * (point.phase_95_deg.high - point.phase_95_deg.low)
    return bool(wide_db <= CONFIDENCE.gain_db and wide_deg <= CONFIDENCE.phase_deg)


def _points(responding: Responding) -> list[ResponsePoint]:
    return [f.point for f in responding.points() if f.point.transfer == MEASURED]


def stepped_s() -> tuple[float, int]:
    """How long the stepped sine takes (s), and how many of its points are as sure as they are to be."""
    definition = _test(
        settle_cycles=2, measure_cycles=MOST_CYCLES, confidence=CONFIDENCE.model_dump()
    )
    responding, ticks = Responding(definition, RIG.period_s), 0
    for chunk in _played(definition):
        responding.take(chunk)
        ticks += int(np.count_nonzero(np.diff(chunk["program_tick"], prepend=-1) != 0))
    return ticks * RIG.period_s, sum(map(_is_within, _points(responding)))


def multisine_s() -> tuple[float, int]:
    """How long the multisine takes until every line is sure, and how many are."""
    definition = _test(method="multisine", settle_cycles=1, measure_cycles=MOST_PERIODS)
    responding, ticks, sure = Responding(definition, RIG.period_s), 0, 0
    for chunk in _played(definition):
        for part in np.array_split(chunk, 40):  # not to see a period's end late
            responding.take(part)
            ticks += len(part)
            sure = sum(map(_is_within, _points(responding)))
            if sure == len(FREQUENCIES_HZ):
                return ticks * RIG.period_s, sure
    return ticks * RIG.period_s, sure


def main(as_json: bool) -> int:
    """Print the figures; returns the exit code."""
    one_by_one_s, steps = stepped_s()
    at_once_s, lines = multisine_s()
    told = f"±{CONFIDENCE.gain_db:g} dB and ±{CONFIDENCE.phase_deg:g}°, {AMPLITUDE_N / 1e3:g} kN"
    wanted = len(FREQUENCIES_HZ)
    figures = [
        Figure(
            "stepped_sine_s",
            "Stepped sine, adaptive, 1-100 Hz at 1 Hz",
            one_by_one_s,
            "s",
            note=told,
        ),
        Figure("stepped_points", "Points of it within the confidence", steps, "", at_least=wanted),
        Figure("multisine_s", "Multisine, 1-100 Hz at 1 Hz", at_once_s, "s", note=told),
        Figure("multisine_lines", "Lines of it within the confidence", lines, "", at_least=wanted),
        Figure(
            "share", "Multisine over stepped sine", at_once_s / one_by_one_s, "×", at_most=SHARE
        ),
    ]
    show("multisine_time", figures, NOTES, as_json)
    return int(any(figure.met is False for figure in figures))
