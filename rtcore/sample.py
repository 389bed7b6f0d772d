"""Sample: from what the converters deliver to tared values, and which sensors can be believed."""

import math

from rtcore.compiled import Record, kernel
from rtcore.interlocks import SensorFault

SMOOTH_OVER_S = 0.05  # over which a sensor's roughness is averaged
ROUGH = 0.25  # of its noise: a sensor that is smoother has lost its converter
DRIFT_OVER_S = 0.25  # over which LVT and LVDT must agree
JUMP_M = 1e-3  # that the unit cannot move in a tick


@kernel
def convert(sensor: Record, value: float, settings: Record) -> int:
    """What a sensor's own codes say of it: a SensorFault. A noisy one neither repeats itself nor runs smoothly."""
    sensor.repeats = sensor.repeats + 1 if value == sensor.last else 0
    bend = abs(value - 2.0 * sensor.last + sensor.before)
    if math.isfinite(bend):
        sensor.roughness += settings.period_s / SMOOTH_OVER_S * (bend - sensor.roughness)
    sensor.before = sensor.last
    sensor.last = value
    if not math.isfinite(value):
        return SensorFault.NOT_A_NUMBER
    if not abs(value) < sensor.range:
        return SensorFault.SATURATED
    if sensor.noise == 0.0:
        return SensorFault.NONE
    if settings.frozen_ticks > 0 and sensor.repeats >= settings.frozen_ticks:
        return SensorFault.FROZEN
    if settings.frozen_ticks > 0 and sensor.roughness < ROUGH * sensor.noise:
        return SensorFault.NOISE_FREE
    return SensorFault.NONE


@kernel
def lasting(sensor: Record, implausible: bool, ticks: int) -> int:
    """IMPLAUSIBLE once a contradiction has lasted: a single noisy code is none."""
    sensor.implausible_ticks = sensor.implausible_ticks + 1 if implausible else 0
    return SensorFault.IMPLAUSIBLE if sensor.implausible_ticks >= ticks else SensorFault.NONE


@kernel
def judge_load_cell(settings: Record, inputs: Record, sample: Record) -> int:
    """The load cell against the chambers: the force is A (p_1 - p_2), but for friction and the rod's inertia."""
    fault = convert(sample.force, inputs.force_n, settings)
    hydraulic_n = settings.area_m2 * (inputs.pressure_1_pa - inputs.pressure_2_pa)
    apart = abs(inputs.force_n - hydraulic_n) > settings.force_implausible_n
    implausible = lasting(sample.force, apart, settings.implausible_ticks)
    return fault if fault != SensorFault.NONE else implausible


@kernel
def judge_lvt(settings: Record, inputs: Record, sample: Record) -> int:
    """The LVT against the LVDT: what the chain's deformation adds has no mean."""
    fault = convert(sample.velocity, inputs.velocity_m_s, settings)
    moved_m_s = (inputs.displacement_m - sample.displacement_m) / settings.period_s
    apart_m_s = inputs.velocity_m_s - moved_m_s
    if math.isfinite(apart_m_s) and abs(moved_m_s) * settings.period_s < JUMP_M:
        share = settings.period_s / DRIFT_OVER_S
        sample.apart_m_s += share * (apart_m_s - sample.apart_m_s)
    if fault == SensorFault.NONE and abs(sample.apart_m_s) > settings.velocity_implausible_m_s:
        return SensorFault.IMPLAUSIBLE
    return fault


@kernel
def judge_lvdt(settings: Record, inputs: Record, sample: Record) -> int:
    """The LVDT by itself: it neither leaves its range nor jumps. It has no noise that would tell whether it lives."""
    jumped = abs(inputs.displacement_m - sample.displacement.last) > JUMP_M
    fault = convert(sample.displacement, inputs.displacement_m, settings)
    return SensorFault.IMPLAUSIBLE if fault == SensorFault.NONE and jumped else fault


@kernel
def judge_pressure(settings: Record, inputs: Record, sample: Record) -> int:
    """The supply's pressure: absolute, so never below nothing."""
    fault = convert(sample.pressure, inputs.supply_pressure_pa, settings)
    below = inputs.supply_pressure_pa < -settings.pressure_offset_pa
    return SensorFault.OUT_OF_RANGE if fault == SensorFault.NONE and below else fault


@kernel
def take_sample(settings: Record, inputs: Record, sample: Record) -> None:
    """Fill the sample of this tick, what is wrong with its sensors included."""
    sample.force.fault = judge_load_cell(settings, inputs, sample)
    sample.velocity.fault = judge_lvt(settings, inputs, sample)
    sample.displacement.fault = judge_lvdt(settings, inputs, sample)
    sample.pressure.fault = judge_pressure(settings, inputs, sample)
    sample.force_n = inputs.force_n - sample.tare_n
    sample.displacement_m = inputs.displacement_m
    sample.velocity_m_s = inputs.velocity_m_s
    if math.isfinite(inputs.force_n):
        sample.untared_mean_n += settings.tare_share * (inputs.force_n - sample.untared_mean_n)


@kernel
def sensors_are_sound(sample: Record) -> bool:
    """Whether every sensor can be believed."""
    return (
        sample.force.fault
        + sample.velocity.fault
        + sample.displacement.fault
        + sample.pressure.fault
        == 0
    )
