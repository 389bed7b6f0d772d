"""Frequency response of the control law's parts, from the gains that the loop itself runs with."""

import math

import numpy as np

from rtcore.compiled import Record
from rtcore.control.filters import FILTER, design_lead, design_low_pass, design_notch


def shift(frequency_hz: float, period_s: float) -> complex:
    """z at a frequency: one tick ahead."""
    return complex(np.exp(2j * math.pi * frequency_hz * period_s))


def filter_response(f: Record, z: complex) -> complex:
    """Of a FILTER record."""
    return complex((f["b0"] + f["b1"] / z + f["b2"] / z**2) / (1.0 + f["a1"] / z + f["a2"] / z**2))


def pid_response(gains: Record, z: complex, period_s: float) -> complex:
    """Valve command to force error (1/N), away from saturation."""
    a = math.exp(-gains["omega_d_rad_s"] * period_s)
    integral = gains["k_i"] * period_s * z / (z - 1.0)
    derivative = gains["k_d"] * (1.0 - a) * (1.0 - 1.0 / z) / (period_s * (1.0 - a / z))
    return complex(gains["k_p"] + integral + derivative)


def feed_forward_response(gains: Record, z: complex, period_s: float) -> complex:
    """Valve command to force setpoint (1/N), beside what the PID makes of it."""
    return complex(gains["k_ff"] * (1.0 - 1.0 / z) / period_s)


def branch_response(gains: Record, load_hz: float | None, z: complex, period_s: float) -> complex:
    """Filtered velocity to velocity: lead, low-pass, and the notch where the load has a frequency."""
    f = np.zeros(1, FILTER)[0]
    design_lead(f, gains["lead_zero_rad_s"], gains["lead_pole_rad_s"], period_s)
    response = filter_response(f, z)
    low_pass = gains["low_pass_rad_s"], gains["low_pass_damping"], int(gains["low_pass_order"])
    design_low_pass(f, *low_pass, period_s)
    response *= filter_response(f, z)
    if load_hz is not None:
        design_notch(f, 2.0 * math.pi * load_hz, gains["notch_damping"], period_s)
        response *= filter_response(f, z)
    return response


def compensation_response(
    gains: Record, load_hz: float | None, z: complex, period_s: float
) -> complex:
    """W: valve command to velocity (s/m), FF_V + FF_A (1 - z⁻¹)/T behind the branch."""
    fed = gains["ff_v"] + gains["ff_a"] * (1.0 - 1.0 / z) / period_s
    return complex(fed * branch_response(gains, load_hz, z, period_s))


def quadrature_gains(
    gains: Record, wanted: complex, load_hz: float | None, z: complex, period_s: float
) -> tuple[float, float]:
    """(FF_V, FF_A) with which the compensation is exactly `wanted` at one frequency."""
    fed = wanted / branch_response(gains, load_hz, z, period_s)
    slope = (1.0 - 1.0 / z) / period_s
    ff_a = fed.imag / slope.imag
    return fed.real - ff_a * slope.real, ff_a
