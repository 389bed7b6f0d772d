"""Frequency response of the compensation branch, filter by filter (figure 11)."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.control.filters import FILTER, design_lead, design_low_pass, design_notch
from rtcore.control.response import filter_response

Complexes = npt.NDArray[np.complex128]


def branch_parts(gains: Any, load_hz: float, z: Complexes, period_s: float) -> Complexes:
    """(3, n): lead, low-pass and notch at (n,) shifts z, of a GAINS record under a load of `load_hz`."""
    lead, low_pass, notch = np.zeros((3, 1), FILTER)[:, 0]
    design_lead(lead, gains["lead_zero_rad_s"], gains["lead_pole_rad_s"], period_s)
    smoothing = gains["low_pass_rad_s"], gains["low_pass_damping"], int(gains["low_pass_order"])
    design_low_pass(low_pass, *smoothing, period_s)
    design_notch(notch, 2.0 * math.pi * load_hz, gains["notch_damping"], period_s)
    return np.array([[filter_response(f, at) for at in z] for f in (lead, low_pass, notch)])
