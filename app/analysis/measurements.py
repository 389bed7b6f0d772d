"""The measurements that a test may be accepted by: name, unit, and where it is read off.

docs/measurements.md says what each is taken over.
"""

from collections.abc import Callable
from typing import NamedTuple

from app.analysis.findings import CycleStatistics, Findings
from app.analysis.sine_responses import gain_db, least_of, share_met
from app.analysis.step_response import StepResponse


class Measurement(NamedTuple):
    """A number read off a run or a block. `read` gives None where there is nothing to measure."""

    name: str
    unit: str
    doc: str
    read: Callable[[Findings], float | None]
    grows: bool = False  # never gets less while a run goes on


def _of_cycles(read: Callable[[CycleStatistics], float]) -> Callable[[Findings], float | None]:
    return lambda found: read(found.cycles) if found.cycles.whole else None


def _of_steps(read: Callable[[StepResponse], float]) -> Callable[[Findings], float | None]:
    return lambda found: None if found.steps.worst is None else read(found.steps.worst)


def _cycles(found: Findings) -> float | None:
    return float(found.cycles.count) if found.has_cycles else None


def _of_several(found: Findings, read: Callable[[list[float]], float]) -> float | None:
    gains = [gain_db(sine) for sine in found.sines]
    return read(gains) if len(gains) > 1 else None


def _delay_s(found: Findings) -> float | None:
    ticks = found.data.delay_ticks
    return None if ticks is None else ticks * found.period_s


_TABLE = (
    Measurement(
        "amplitude_n",
        "N",
        "Amplitude of the force at the load frequency, over counted cycles of one sine",
        lambda found: found.of_the_one_sine(lambda sine: sine.amplitude_n),
    ),
    Measurement(
        "mean_n",
        "N",
        "Mean of the force over counted cycles of one sine",
        lambda found: found.of_the_one_sine(lambda sine: sine.mean_n),
    ),
    Measurement(
        "amplitude_error_percent",
        "%",
        "Amplitude above (+) or below (−) what was asked for; of several sines the farthest off",
        lambda found: found.worst_sine(lambda sine: sine.amplitude_error_percent),
    ),
    Measurement(
        "phase_deg",
        "°",
        "Phase of the force against the recorded setpoint, negative where it lags; of several "
        "sines the largest",
        lambda found: found.worst_sine(lambda sine: sine.phase_deg),
    ),
    Measurement(
        "total_harmonic_distortion_percent",
        "%",
        "Harmonics 2 to 10 of the force, below half the loop rate, in % of the first; of several "
        "sines the largest",
        lambda found: found.worst_sine(lambda sine: sine.distortion_percent),
    ),
    Measurement(
        "response_peak_db",
        "dB",
        "Greatest gain from setpoint to force at any of several sines",
        lambda found: _of_several(found, lambda gains: max(gains)),
    ),
    Measurement(
        "response_least_db",
        "dB",
        "Least gain from setpoint to force at any of several sines",
        lambda found: _of_several(found, lambda gains: min(gains)),
    ),
    Measurement(
        "bandwidth_minus_3_db_hz",
        "Hz",
        "Lowest frequency, between sines of one amplitude, at which the gain falls below -3 dB",
        lambda found: least_of(found.sines, lambda extremes: extremes.minus_3_db_hz),
    ),
    Measurement(
        "phase_minus_90_deg_hz",
        "Hz",
        "Lowest frequency, between sines of one amplitude, at which the force lags by 90°",
        lambda found: least_of(found.sines, lambda extremes: extremes.minus_90_deg_hz),
    ),
    Measurement(
        "bands_met",
        "1",
        "Share of the sines within the required bands of a frequency response that meet them",
        lambda found: share_met(found.sines, found.required),
    ),
    Measurement("cycles", "1", "Cycles at full amplitude that are over", _cycles, grows=True),
    Measurement(
        "mean_peak_n",
        "N",
        "Mean of the highest force of each counted cycle",
        _of_cycles(lambda cycles: cycles.peak_sum_n / cycles.whole),
    ),
    Measurement(
        "mean_valley_n",
        "N",
        "Mean of the lowest force of each counted cycle",
        _of_cycles(lambda cycles: cycles.valley_sum_n / cycles.whole),
    ),
    Measurement(
        "highest_peak_n",
        "N",
        "Highest force of all counted cycles",
        _of_cycles(lambda cycles: cycles.highest_n),
        grows=True,
    ),
    Measurement(
        "lowest_valley_n",
        "N",
        "Lowest force of all counted cycles",
        _of_cycles(lambda cycles: cycles.lowest_n),
    ),
    Measurement(
        "force_error_rms_n",
        "N",
        "Setpoint minus load cell, over the data",
        lambda found: found.data.error_rms_n,
    ),
    Measurement(
        "force_error_peak_n",
        "N",
        "Largest setpoint minus load cell, over the data",
        lambda found: found.data.error_peak_n,
        grows=True,
    ),
    Measurement(
        "delay_s",
        "s",
        "How long the force follows behind the setpoint of holds, ramps, sweeps and time histories",
        _delay_s,
    ),
    Measurement(
        "goodness_of_fit",
        "%",
        "G of the paper against the prediction, over the data",
        lambda found: found.data.goodness_percent,
    ),
    Measurement(
        "peak_force_n",
        "N",
        "Largest force either way, tapers and lead-ins included",
        lambda found: found.whole.force_peak_n,
        grows=True,
    ),
    Measurement(
        "peak_displacement_m",
        "m",
        "Largest displacement either way, tapers and lead-ins included",
        lambda found: found.whole.displacement_peak_m,
        grows=True,
    ),
    Measurement(
        "peak_velocity_m_s",
        "m/s",
        "Largest velocity either way, tapers and lead-ins included",
        lambda found: found.whole.velocity_peak_m_s,
        grows=True,
    ),
    Measurement(
        "valve_saturation_share",
        "1",
        "Share of the time in which the valve command was at its limit",
        lambda found: found.whole.saturation_share,
    ),
    Measurement(
        "step_overshoot_percent",
        "%",
        "Largest overshoot of all steps, in % of the step",
        _of_steps(lambda step: step.overshoot_percent),
        grows=True,
    ),
    Measurement(
        "step_rise_s",
        "s",
        "Longest rise of all steps, from 10 to 90 %",
        _of_steps(lambda step: step.rise_s),
        grows=True,
    ),
    Measurement(
        "step_settling_s",
        "s",
        "Longest time of all steps until the force stays within 2 %",
        _of_steps(lambda step: step.settling_s),
        grows=True,
    ),
    Measurement(
        "step_dead_time_s",
        "s",
        "Longest time of all steps from the command to the first 5 % of the step",
        _of_steps(lambda step: step.dead_time_s),
        grows=True,
    ),
    Measurement(
        "step_steady_error_n",
        "N",
        "Largest error of all steps that stays: of the mean force over the second half of the hold",
        _of_steps(lambda step: step.steady_error),
        grows=True,
    ),
)
MEASUREMENTS = {measurement.name: measurement for measurement in _TABLE}

Values = dict[str, float | None]


def read_all(found: Findings) -> Values:
    """Every measurement by name; None where there is nothing to measure."""
    return {name: measurement.read(found) for name, measurement in MEASUREMENTS.items()}


def nothing() -> Values:
    """Of a run without any data."""
    return dict.fromkeys(MEASUREMENTS)
