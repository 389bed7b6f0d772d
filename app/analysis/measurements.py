"""The measurements that a test may be accepted by: name, unit, and a function of the evidence."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Evidence
from app.analysis.goodness import goodness_of_fit
from app.analysis.step_response import StepResponse, step_response

SATURATED_WITHIN = 1e-6


class Measurement(NamedTuple):
    """A number read off a run. `measure` gives None where the run holds nothing to measure."""

    name: str
    unit: str
    doc: str
    measure: Callable[[Evidence], float | None]


def _rms(values: npt.NDArray[np.floating]) -> float | None:
    if len(values) == 0:
        return None
    return float(np.sqrt(np.mean(np.asarray(values, np.float64) ** 2)))


def _peak(values: npt.NDArray[np.floating]) -> float | None:
    return float(np.max(np.abs(values))) if len(values) else None


def _goodness(evidence: Evidence) -> float | None:
    if evidence.reference_n is None:
        return None
    mask = evidence.data_mask
    return goodness_of_fit(evidence.records["force_n"][mask], evidence.reference_n[mask])


def _saturation(evidence: Evidence) -> float:
    limit = evidence.valve_limit - SATURATED_WITHIN
    return float(np.mean(np.abs(evidence.records["valve_command"]) >= limit))


def _worst_step(read: Callable[[StepResponse], float]) -> Callable[[Evidence], float | None]:
    """The worst of all steps; NaN, which no limit passes, where one did not get that far."""

    def measure(evidence: Evidence) -> float | None:
        values = []
        for step in evidence.windows.steps:
            force_n = evidence.within(step.first, step.last)["force_n"]
            if len(force_n) and step.begin_n != step.end_n:
                response = step_response(force_n, step.begin_n, step.end_n, evidence.period_s)
                values.append(read(response))
        return float(np.max(values)) if values else None

    return measure


_TABLE = (
    Measurement(
        "force_error_rms_n",
        "N",
        "Setpoint minus load cell, over the data",
        lambda e: _rms(e.data["force_error_n"]),
    ),
    Measurement(
        "force_error_peak_n",
        "N",
        "Largest setpoint minus load cell, over the data",
        lambda e: _peak(e.data["force_error_n"]),
    ),
    Measurement(
        "peak_force_n",
        "N",
        "Largest force either way, over the whole run",
        lambda e: _peak(e.records["force_n"]),
    ),
    Measurement(
        "peak_displacement_m",
        "m",
        "Largest displacement either way, over the whole run",
        lambda e: _peak(e.records["displacement_m"]),
    ),
    Measurement(
        "valve_saturation_share",
        "1",
        "Share of the run in which the valve command was at its limit",
        _saturation,
    ),
    Measurement("goodness_of_fit", "%", "G of the paper against a reference run", _goodness),
    Measurement(
        "step_overshoot_percent",
        "%",
        "Largest overshoot of all steps, in % of the step",
        _worst_step(lambda response: response.overshoot_percent),
    ),
    Measurement(
        "step_rise_s",
        "s",
        "Longest rise of all steps, from 10 to 90 %",
        _worst_step(lambda response: response.rise_s),
    ),
    Measurement(
        "step_settling_s",
        "s",
        "Longest time of all steps until the force stays within 2 %",
        _worst_step(lambda response: response.settling_s),
    ),
)
MEASUREMENTS = {measurement.name: measurement for measurement in _TABLE}


def measure_all(evidence: Evidence) -> dict[str, float | None]:
    """Every measurement of a run by name; None where there is nothing to measure."""
    if len(evidence.records) == 0:
        return dict.fromkeys(MEASUREMENTS)
    return {name: measurement.measure(evidence) for name, measurement in MEASUREMENTS.items()}
