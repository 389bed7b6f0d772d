"""Kinematic compensation (paper section 6, figures 10 and 11): velocity and acceleration of the unit, fed forward.

The LVT's signal passes lead, low-pass and a notch that follows the load frequency; the filtered velocity and
its derivative are in quadrature and each have a gain. Branch and notch join and leave by fading, so that
excluding them for a non-harmonic load makes no bump.
"""

import math

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.control.filters import (
    FILTER,
    clear_filter,
    design_lead,
    design_low_pass,
    design_notch,
    filter_step,
)
from rtcore.program.segments import Branch

COMPENSATION = np.dtype(
    [
        ("lead", FILTER),
        ("low_pass", FILTER),
        ("notch", FILTER),
        ("notch_hz", "f8"),
        ("branch_share", "f8"),  # 0 excluded … 1 in use
        ("notch_share", "f8"),
        ("filtered_m_s", "f8"),
        ("velocity_term", "f8"),  # valve command
        ("acceleration_term", "f8"),  # valve command
    ],
    align=True,
)

LOWEST_NOTCH_HZ = 0.1


@kernel
def design_compensation(gains: Record, comp: Record, period_s: float) -> None:
    """Adopt new gains; the filters keep their memory."""
    design_lead(comp.lead, gains.lead_zero_rad_s, gains.lead_pole_rad_s, period_s)
    design_low_pass(
        comp.low_pass, gains.low_pass_rad_s, gains.low_pass_damping, gains.low_pass_order, period_s
    )
    comp.notch_hz = math.nan


@kernel
def reset_compensation(comp: Record) -> None:
    """Forget the past and stand excluded."""
    clear_filter(comp.lead)
    clear_filter(comp.low_pass)
    clear_filter(comp.notch)
    comp.branch_share = 0.0
    comp.notch_share = 0.0
    comp.filtered_m_s = 0.0
    comp.velocity_term = 0.0
    comp.acceleration_term = 0.0


@kernel
def _faded(share: float, wanted: bool, step: float) -> float:
    return min(share + step, 1.0) if wanted else max(share - step, 0.0)


@kernel
def compensation_step(
    gains: Record, comp: Record, velocity_m_s: float, load_hz: float, branch: int, period_s: float
) -> float:
    """The compensation in valve command, dimensionless: FF_V v_f + FF_A Δv_f/T."""
    if load_hz != comp.notch_hz and load_hz >= LOWEST_NOTCH_HZ:
        design_notch(comp.notch, 2.0 * math.pi * load_hz, gains.notch_damping, period_s)
        comp.notch_hz = load_hz
    step = period_s / gains.fade_s
    comp.branch_share = _faded(
        comp.branch_share, gains.compensate != 0 and branch != Branch.EXCLUDED, step
    )
    comp.notch_share = _faded(
        comp.notch_share, branch == Branch.WITH_NOTCH and load_hz >= LOWEST_NOTCH_HZ, step
    )

    smooth = filter_step(comp.low_pass, filter_step(comp.lead, velocity_m_s))
    notched = filter_step(comp.notch, smooth)
    filtered = smooth + comp.notch_share * (notched - smooth)
    comp.velocity_term = comp.branch_share * gains.ff_v * filtered
    comp.acceleration_term = (
        comp.branch_share * gains.ff_a * (filtered - comp.filtered_m_s) / period_s
    )
    comp.filtered_m_s = filtered
    return comp.velocity_term + comp.acceleration_term
