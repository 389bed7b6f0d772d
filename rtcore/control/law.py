"""The control law: PID, feed-forward and compensation, limited in size and slew."""

import math

import numpy as np

from rtcore.compiled import Record, kernel
from rtcore.control.compensation import (
    COMPENSATION,
    compensation_step,
    design_compensation,
    reset_compensation,
)
from rtcore.control.pid import PID, pid_step, reset_pid

LAW = np.dtype([("pid", PID), ("compensation", COMPENSATION), ("valve", "f8")], align=True)


@kernel
def adopt_gains(gains: Record, law: Record, period_s: float) -> None:
    """Make new gains effective."""
    design_compensation(gains, law.compensation, period_s)


@kernel
def open_loop(law: Record, setpoint_n: float, force_n: float) -> None:
    """The valve at null, and nothing remembered that could bump when the loop closes."""
    reset_pid(law.pid, setpoint_n, force_n)
    reset_compensation(law.compensation)
    law.valve = 0.0


@kernel
def closed_loop(
    gains: Record,
    law: Record,
    setpoint_n: float,
    force_n: float,
    velocity_m_s: float,
    load_hz: float,
    branch: int,
    period_s: float,
) -> float:
    """The valve command of this tick, -1…+1."""
    fed_forward = compensation_step(
        gains, law.compensation, velocity_m_s, load_hz, branch, period_s
    )
    step = gains.valve_slew_per_s * period_s
    lowest = max(-gains.valve_limit, law.valve - step)
    highest = min(gains.valve_limit, law.valve + step)
    law.valve = pid_step(
        gains, law.pid, setpoint_n, force_n, fed_forward, lowest, highest, period_s
    )
    return law.valve


@kernel
def gains_are_valid(gains: Record, period_s: float) -> bool:
    """Whether the loop may run with these gains: finite, and each within what it can mean."""
    for value in (gains.k_p, gains.k_i, gains.k_d, gains.k_ff, gains.ff_v, gains.ff_a):
        if not abs(value) < 1e6:
            return False
    for value in (
        gains.omega_d_rad_s,
        gains.lead_zero_rad_s,
        gains.lead_pole_rad_s,
        gains.low_pass_rad_s,
    ):
        if not 0.0 < value < 1e6:
            return False
    if gains.low_pass_order == 2 and not gains.low_pass_rad_s * period_s < math.pi:
        return False  # beyond half the loop rate the prewarped filter is unstable
    damped = 0.0 < gains.low_pass_damping < 10.0 and 0.0 < gains.notch_damping < 10.0
    limited = 0.0 < gains.valve_limit <= 1.0 and gains.valve_slew_per_s > 0.0
    return damped and limited and 1e-4 <= gains.fade_s <= 10.0 and 1 <= gains.low_pass_order <= 2
