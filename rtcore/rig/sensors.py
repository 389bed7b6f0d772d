"""What the converters see of the plant: chains are in the plant, noise and 16-bit steps are here."""

import numpy as np

from rtcore.compiled import Array, Record, kernel
from rtcore.rig.noise import two_normals
from rtcore.rig.plant import P_1, P_2, P_S, X_S, X_T, Y_F, Y_V

SENSORS = np.dtype(
    [
        ("force_noise_n", "f8"),
        ("velocity_noise_m_s", "f8"),
        ("force_lsb_n", "f8"),
        ("velocity_lsb_m_s", "f8"),
        ("displacement_lsb_m", "f8"),
        ("pressure_lsb_pa", "f8"),
        ("valve_lsb", "f8"),
        ("half_codes", "f8"),  # codes on either side of zero
    ],
    align=True,
)


@kernel
def quantise(value: float, lsb: float, half_codes: float) -> float:
    """To the nearest step of a converter, held at its ends. An lsb of 0 is an ideal converter."""
    if lsb == 0.0:
        return value
    return min(max(np.rint(value / lsb), -half_codes), half_codes - 1.0) * lsb


@kernel
def read_sensors(sensors: Record, plant: Record, noise: Record, y: Array, inputs: Record) -> None:
    """Fill the loop's inputs from the plant's state."""
    n_force, n_velocity = two_normals(noise)
    codes = sensors.half_codes
    inputs.force_n = quantise(y[Y_F] + sensors.force_noise_n * n_force, sensors.force_lsb_n, codes)
    inputs.velocity_m_s = quantise(
        y[Y_V] + sensors.velocity_noise_m_s * n_velocity, sensors.velocity_lsb_m_s, codes
    )
    inputs.displacement_m = quantise(y[X_T], sensors.displacement_lsb_m, codes)
    inputs.spool_position = quantise(y[X_S] / plant.spool_stroke_m, sensors.valve_lsb, 1.25 * codes)
    inputs.pressure_1_pa = quantise(y[P_1], sensors.pressure_lsb_pa, codes)
    inputs.pressure_2_pa = quantise(y[P_2], sensors.pressure_lsb_pa, codes)
    inputs.supply_pressure_pa = quantise(y[P_S], sensors.pressure_lsb_pa, codes)
    inputs.chain = 1
