"""Sample: from what the converters deliver to tared values, and which sensors can be believed."""

import math

from rtcore.compiled import Record, kernel


@kernel
def sensor_is_faulty(sensor: Record, value: float, full_scale: float, frozen_ticks: int) -> bool:
    """Whether a noisy sensor is not finite, at the end of its range, or repeats itself to the last bit."""
    sensor.repeats = sensor.repeats + 1 if value == sensor.last else 0
    sensor.last = value
    frozen = frozen_ticks > 0 and sensor.repeats >= frozen_ticks
    return frozen or not (abs(value) < full_scale)


@kernel
def take_sample(settings: Record, inputs: Record, sample: Record) -> None:
    """Fill the sample of this tick, its count of faulty sensors included."""
    faults = 0
    if sensor_is_faulty(
        sample.force, inputs.force_n, settings.force_range_n, settings.frozen_ticks
    ):
        faults += 1
    if sensor_is_faulty(
        sample.velocity, inputs.velocity_m_s, settings.velocity_range_m_s, settings.frozen_ticks
    ):
        faults += 1
    if not (abs(inputs.displacement_m) < settings.displacement_range_m):
        faults += 1
    if not math.isfinite(inputs.supply_pressure_pa):
        faults += 1
    sample.faults = faults
    sample.force_n = inputs.force_n - sample.tare_n
    sample.displacement_m = inputs.displacement_m
    sample.velocity_m_s = inputs.velocity_m_s
    if math.isfinite(inputs.force_n):
        sample.untared_mean_n += settings.tare_share * (inputs.force_n - sample.untared_mean_n)
