"""Discrete filters of the compensation branch: Tustin; the notch and the second-order low-pass prewarped."""

import math

import numpy as np

from rtcore.compiled import Record, kernel

# y = b0 x + s1; s1 = b1 x - a1 y + s2; s2 = b2 x - a2 y (transposed direct form II)
FILTER = np.dtype([(name, "f8") for name in ("b0", "b1", "b2", "a1", "a2", "s1", "s2")], align=True)


@kernel
def filter_step(f: Record, x: float) -> float:
    """The filter's output for its next input."""
    y = f.b0 * x + f.s1
    f.s1 = f.b1 * x - f.a1 * y + f.s2
    f.s2 = f.b2 * x - f.a2 * y
    return y


@kernel
def clear_filter(f: Record) -> None:
    """Forget the past."""
    f.s1 = 0.0
    f.s2 = 0.0


@kernel
def design_lead(f: Record, zero_rad_s: float, pole_rad_s: float, period_s: float) -> None:
    """(1 + s/ω_z)/(1 + s/ω_p) · ω_z/ω_p, which is 1 far above the pole."""
    k = 2.0 / period_s
    scale = 1.0 / (pole_rad_s + k)
    f.b0 = (zero_rad_s + k) * scale
    f.b1 = (zero_rad_s - k) * scale
    f.b2 = 0.0
    f.a1 = (pole_rad_s - k) * scale
    f.a2 = 0.0


@kernel
def design_low_pass(
    f: Record, cutoff_rad_s: float, damping: float, order: int, period_s: float
) -> None:
    """First order 1/(1 + s/ω), or second order ω²/(s² + 2ζωs + ω²)."""
    if order == 1:
        k = 2.0 / period_s
        scale = 1.0 / (cutoff_rad_s + k)
        f.b0 = cutoff_rad_s * scale
        f.b1 = f.b0
        f.b2 = 0.0
        f.a1 = (cutoff_rad_s - k) * scale
        f.a2 = 0.0
        return
    k = math.tan(0.5 * cutoff_rad_s * period_s)
    scale = 1.0 / (1.0 + 2.0 * damping * k + k * k)
    f.b0 = k * k * scale
    f.b1 = 2.0 * f.b0
    f.b2 = f.b0
    f.a1 = 2.0 * (k * k - 1.0) * scale
    f.a2 = (1.0 - 2.0 * damping * k + k * k) * scale


@kernel
def design_notch(f: Record, centre_rad_s: float, damping: float, period_s: float) -> None:
    """(s² + ω²)/(s² + 2ζωs + ω²), exact at its centre."""
    k = math.tan(0.5 * centre_rad_s * period_s)
    scale = 1.0 / (1.0 + 2.0 * damping * k + k * k)
    f.b0 = (1.0 + k * k) * scale
    f.b1 = 2.0 * (k * k - 1.0) * scale
    f.b2 = f.b0
    f.a1 = f.b1
    f.a2 = (1.0 - 2.0 * damping * k + k * k) * scale
