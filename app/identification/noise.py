"""How much each measured channel trembles by itself: what a residual is weighed against."""

import math

import numpy as np
import numpy.typing as npt

from rtcore.rig.parameters import Sensors

Floats = npt.NDArray[np.float64]


def steps(sensors: Sensors) -> Floats:
    """(7,) the step of each measured channel's converter, in the order of `model.MEASURED`."""
    half = 2.0 ** (sensors.bits - 1)
    pressure = sensors.pressure_range_pa
    ranges = (
        1.0, pressure, pressure, pressure,
        sensors.force_range_n, sensors.velocity_range_m_s, sensors.displacement_range_m,
    )  # fmt: skip
    return np.array(ranges) / half


def deviations(sensors: Sensors) -> Floats:
    """(7,) standard deviations: noise at the converter, and its step as if it were even noise."""
    white = np.array([0, 0, 0, 0, sensors.force_noise_n, sensors.velocity_noise_m_s, 0])
    return np.asarray(np.hypot(white, steps(sensors) / math.sqrt(12.0)))


def held(valve: Floats, bits: int) -> Floats:
    """(n,) the valve commands that the converter holds, of those that were computed."""
    half = 2.0 ** (bits - 1)
    return np.asarray(np.clip(np.rint(valve * half), -half, half - 1.0) / half)
