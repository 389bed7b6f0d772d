"""The open loop of a run and its margins, from the plant as it was measured while the loop was closed.

The controller is that which is frozen with the run. In a stepped sine, or in a sweep, the compensation's notch
stands at the very frequency that is measured and takes its branch out of the loop there; a multisine has it in
the loop, without a notch, where the test asks for it. With the frequency of a load the loop is told as it would
be under that load, its notch at that frequency.
"""

import math
from collections.abc import Iterable, Mapping
from typing import Any, cast

import numpy as np

from app.analysis.phasors import Complex
from app.analysis.response.margins import margins_of, open_loop
from app.analysis.response.point import Interval, ResponsePoint
from app.analysis.response.transfers import EVERY
from app.conducting.found import Found
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.runs.response_schemas import ExtremesOut, LoopMargins, ResponseSeries, TransferName
from rtcore.compiled import Array
from rtcore.control.response import compensation_response, shift

LOOP, PLANT, MOTION = "loop", "plant", "motion"
NOT_AT_ALL = 180.0  # half a turn: the phase may be any


def loop_points(
    points: Iterable[Found],
    definition: Definition,
    controller: Mapping[str, Any],
    period_s: float,
    load_hz: float | None = None,
) -> list[Found]:
    """A point of the loop for each of the plant; none where the run's settings cannot be read any more."""
    try:
        gains = to_record(ControllerSettings.model_validate(controller))
    except ValueError:  # settings of another version
        return []
    there = list(points)
    moved = {_key(one): one for one in there if one.point.transfer == MOTION}
    unnotched = definition.controller.compensation == "on"
    found = []
    for plant in (one for one in there if one.point.transfer == PLANT):
        compensated = load_hz is not None or (unnotched and plant.method == "multisine")
        motion = moved.get(_key(plant)) if compensated else None
        if compensated and motion is None:
            continue  # what the compensation does cannot be told without
        found.append(_looped(plant, motion, gains, period_s, load_hz))
    return found


def loop_margins(series: Iterable[ResponseSeries]) -> list[LoopMargins]:
    """What is read off each series of the loop, in their order."""
    return [_margins(one) for one in series]


def without_extremes(series: Iterable[ResponseSeries]) -> list[ResponseSeries]:
    """The same: peak, dip and corners of an open loop say nothing, its margins do."""
    return [one.model_copy(update={"extremes": ExtremesOut()}) for one in series]


def available_of(points: Iterable[Found]) -> list[TransferName]:
    """Those transfers of which there are points, or whose points these make; of none yet, that of the force."""
    there = {found.point.transfer for found in points}
    there |= {LOOP} if PLANT in there else set()
    return [cast(TransferName, name) for name in EVERY if name in there] or ["force"]


def _key(found: Found) -> tuple[str, int, float, float | None, float, float]:
    p = found.point
    return found.method, p.block, p.amplitude_n, p.asked_n, p.mean_n, p.frequency_hz


def _looped(
    plant: Found, motion: Found | None, gains: Any, period_s: float, load_hz: float | None
) -> Found:
    """L = C P − W P_v at one frequency; as far off as plant and motion together can be."""
    p, at = plant.point, np.array([plant.point.frequency_hz])
    both = [p] if motion is None else [p, motion.point]
    gain, moved = _response(p), np.zeros(1) if motion is None else _response(motion.point)
    loop = complex(_loop(at, gain, moved, gains, period_s, load_hz, motion is not None)[0])
    radius = _reach(p) * abs(_loop(at, np.ones(1), np.zeros(1), gains, period_s, None, False)[0])
    if motion is not None:
        told = _loop(at, np.zeros(1), np.ones(1), gains, period_s, load_hz, True)[0]
        radius += _reach(motion.point) * abs(told)
    return plant._replace(
        noise_std=None,
        nonlinear_std=None,
        point=p._replace(
            transfer=LOOP,
            gain=abs(loop),
            phase_deg=math.degrees(math.atan2(loop.imag, loop.real)),
            gain_95=Interval(max(0.0, abs(loop) - radius), abs(loop) + radius),
            phase_95_deg=_turned(loop, radius),
            coherence=_least(one.coherence for one in both),
            distortion_percent=None,
            cycles=min(one.cycles for one in both),
            settled=all(one.settled for one in both),
        ),
    )


def _least(coherences: Iterable[float | None]) -> float | None:
    """None where one of them is not known."""
    known = list(coherences)
    return None if None in known else min(one for one in known if one is not None)


def _loop(
    frequencies_hz: Array,
    plant: Complex | Array,
    motion: Complex | Array,
    gains: Any,
    period_s: float,
    load_hz: float | None,
    compensated: bool,
) -> Complex:
    plant, motion = np.asarray(plant, np.complex128), np.asarray(motion, np.complex128)
    loop = open_loop(frequencies_hz, plant, motion, gains, period_s, load_hz)
    if not compensated or load_hz is not None:
        return loop
    shifts = [shift(float(hz), period_s) for hz in frequencies_hz]
    branch = [compensation_response(gains, None, z, period_s) for z in shifts]
    return np.asarray(loop - np.array(branch) * motion)


def _response(point: ResponsePoint) -> Complex:
    return np.array([point.gain * np.exp(1j * math.radians(point.phase_deg))])


def _reach(point: ResponsePoint) -> float:
    low, high = point.gain_95
    return max(high - point.gain, point.gain - low)


def _turned(loop: complex, radius: float) -> Interval:
    phase_deg = math.degrees(math.atan2(loop.imag, loop.real))
    within = radius < abs(loop)
    half_deg = math.degrees(math.asin(radius / abs(loop))) if within else NOT_AT_ALL
    return Interval(phase_deg - half_deg, phase_deg + half_deg)


def _margins(series: ResponseSeries) -> LoopMargins:
    frequencies_hz = np.array([p.frequency_hz for p in series.points])
    gain = np.array([p.gain for p in series.points])
    loop = gain * np.exp(1j * np.radians([p.phase_deg for p in series.points]))
    found = margins_of(frequencies_hz, loop)
    return LoopMargins(
        block=series.block,
        method=series.method,
        amplitude_n=series.amplitude_n,
        mean_n=series.mean_n,
        crossover_hz=_number(found.crossover_hz),
        phase_margin_deg=_number(found.phase_deg),
        gain_margin_db=_number(found.gain_db),
        turnover_hz=_number(found.turnover_hz),
        worst_sensitivity=_number(found.worst_sensitivity),
    )


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
