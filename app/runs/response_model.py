"""The linear model's curve behind a measured response: computed once for each rig, controller, amplitude and mean."""

import json
from collections import OrderedDict
from collections.abc import Iterable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from threading import Lock
from typing import Any, NamedTuple

import numpy as np

from app.analysis.force_loop import ForceLoop
from app.analysis.linear import linear_rig
from app.analysis.phasors import Complex
from app.analysis.response.unit_under_test import servo
from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.rig_configuration.record import model_of
from app.runs.response_schemas import ModelCurve, ResponseSeries
from rtcore.compiled import Array

POINTS = 120
MOST_KEPT = 64


class Load(NamedTuple):
    """For which amplitude and mean (N), and between which frequencies (Hz)."""

    amplitude_n: float
    mean_n: float
    from_hz: float
    to_hz: float


class Loop(NamedTuple):
    """The open loop: the compensation in it where a load has a frequency."""

    load_hz: float | None = None


def loads_of(series: Iterable[ResponseSeries]) -> list[Load]:
    """Those of series that are more than a point, each once."""
    many = (one for one in series if len(one.points) > 1)
    ends = ((s, s.points[0].frequency_hz, s.points[-1].frequency_hz) for s in many)
    return list(dict.fromkeys(Load(s.amplitude_n, s.mean_n, low, high) for s, low, high in ends))


class ModelCurves:
    """Computes curves in a thread of its own and keeps them. May be asked from any thread."""

    def __init__(self) -> None:
        self._worker = ThreadPoolExecutor(1, "model-curves")
        self._kept: OrderedDict[tuple[str, Load, Loop | None], Future[ModelCurve | None]] = (
            OrderedDict()
        )
        self._lock = Lock()

    def of(
        self,
        run: Mapping[str, Any],
        loads: Iterable[Load],
        period_s: float,
        wait_s: float,
        loop: Loop | None = None,
    ) -> list[ModelCurve]:
        """The curves of these loads that are there within so long; `run` has its `rig` and `controller`.

        Those of the open loop where one is named.
        """
        made_with = json.dumps([run["rig"], run["controller"], period_s], sort_keys=True)
        futures = [self._future(made_with, load, run, period_s, loop) for load in loads]
        done, _ = wait(futures, wait_s)
        found = (future.result() for future in futures if future in done)
        return [curve for curve in found if curve is not None]

    def close(self) -> None:
        """Compute no more."""
        self._worker.shutdown(cancel_futures=True)

    def _future(
        self,
        made_with: str,
        load: Load,
        run: Mapping[str, Any],
        period_s: float,
        loop: Loop | None,
    ) -> "Future[ModelCurve | None]":
        key = made_with, load, loop
        with self._lock:
            if key not in self._kept:
                self._kept[key] = self._worker.submit(model_curve, run, load, period_s, loop)
                while len(self._kept) > MOST_KEPT:
                    self._kept.popitem(last=False)
            return self._kept[key]


def position_curve(run: Mapping[str, Any], load: Load) -> ModelCurve | None:
    """The unit's position response, as its servo of second order has it under any load; None without a model."""
    try:
        rig = model_of(run["rig"])
    except ValueError:
        return None
    frequencies_hz = _between(load)
    return _curve(load, frequencies_hz, servo(rig, frequencies_hz))


def model_curve(
    run: Mapping[str, Any], load: Load, period_s: float, loop: Loop | None = None
) -> ModelCurve | None:
    """Force to setpoint of the rig linearised for a load, or its open loop; None where it cannot be."""
    try:
        rig = linear_rig(model_of(run["rig"]), load.amplitude_n, load.mean_n)
        gains = to_record(ControllerSettings.model_validate(run["controller"]))
    except ValueError:  # a mean that this rig cannot hold, or settings of another version
        return None
    frequencies_hz = _between(load)
    linear = ForceLoop(rig, gains, period_s, None if loop is None else loop.load_hz)
    responses = linear.closed_loops if loop is None else linear.open_loops
    return _curve(load, frequencies_hz, responses(frequencies_hz))


def _between(load: Load) -> Array:
    return np.geomspace(load.from_hz, load.to_hz, POINTS)


def _curve(load: Load, frequencies_hz: Array, response: Complex) -> ModelCurve:
    return ModelCurve(
        amplitude_n=load.amplitude_n,
        mean_n=load.mean_n,
        frequencies_hz=frequencies_hz.tolist(),
        gain=np.abs(response).tolist(),
        phase_deg=np.degrees(np.unwrap(np.angle(response))).tolist(),
    )
