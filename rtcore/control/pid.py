"""PID with a filtered derivative, command feed-forward and clamping anti-windup (paper eqs 9-10, section 7)."""

import math

import numpy as np

from rtcore.compiled import Record, kernel

PID = np.dtype(
    [("integral", "f8"), ("derivative", "f8"), ("error_n", "f8"), ("setpoint_n", "f8")], align=True
)


@kernel
def reset_pid(pid: Record, setpoint_n: float, force_n: float) -> None:
    """Start without a bump: no integral, no derivative of a jump that never was."""
    pid.integral = 0.0
    pid.derivative = 0.0
    pid.error_n = setpoint_n - force_n
    pid.setpoint_n = setpoint_n


@kernel
def pid_step(
    gains: Record,
    pid: Record,
    setpoint_n: float,
    force_n: float,
    compensation: float,
    lowest: float,
    highest: float,
    period_s: float,
) -> float:
    """The valve command, saturated at `lowest` and `highest`.

    V = K_P e + I + K_D d + K_FF ΔF_set/T + compensation; the integrator takes its new value only where V
    is not saturated, or where the error drives it out of saturation.
    """
    error_n = setpoint_n - force_n
    a = math.exp(-gains.omega_d_rad_s * period_s)
    pid.derivative = a * pid.derivative + (1.0 - a) * (error_n - pid.error_n) / period_s
    integral = pid.integral + gains.k_i * error_n * period_s
    rate_n_s = (setpoint_n - pid.setpoint_n) / period_s
    wanted = (
        gains.k_p * error_n
        + integral
        + gains.k_d * pid.derivative
        + gains.k_ff * rate_n_s
        + compensation
    )
    valve = min(max(wanted, lowest), highest)
    if wanted == valve or (wanted - valve) * error_n < 0.0:
        pid.integral = integral
    pid.error_n = error_n
    pid.setpoint_n = setpoint_n
    return valve
