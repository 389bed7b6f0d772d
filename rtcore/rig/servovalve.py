"""The servovalve: first stage, spool with its electronics, and the four metering lands."""

import math

from rtcore.compiled import kernel

CURRENT_LIMIT = 1.5  # of the torque motor, as a share of the flapper's travel


@kernel
def flapper_stop(plant, x_f, v_f):
    """Acceleration (1/s²) by which a stop at ±1 pushes the flapper back; it never pulls."""
    depth = abs(x_f) - 1.0
    if not depth > 0.0:
        return 0.0
    side = math.copysign(1.0, x_f)
    wf = plant.omega_f_rad_s
    spring = wf * wf * plant.flapper_stop_k * depth
    damper = 2.0 * plant.zeta_f * wf * plant.flapper_stop_c * v_f * side * min(50.0 * depth, 1.0)
    return side * max(0.0, spring + damper)


@kernel
def spool_motion(plant, x_f, v_f, x_s, command):
    """(flapper acceleration, spool velocity) for a valve command of -1…+1."""
    wf = plant.omega_f_rad_s
    error = plant.k_spool_1_m * (command * plant.spool_stroke_m - x_s)
    current = min(max(error, -CURRENT_LIMIT), CURRENT_LIMIT)
    flapper = wf * wf * (current - x_f) - 2.0 * plant.zeta_f * wf * v_f - flapper_stop(plant, x_f, v_f)
    beyond = max(x_s - plant.spool_stroke_m, 0.0) - max(-x_s - plant.spool_stroke_m, 0.0)
    return flapper, plant.spool_rate_m_s * x_f - plant.spool_stop_k * beyond


@kernel
def land_flow(plant, opening_m, drop_pa):
    """Flow (m³/s) through one land: an orifice of width w, radial clearance c_r and Reynolds-dependent C_d.

    The closed-form root of Δp = R Q + k Q|Q| with k = ρ0/(2 (C_d w h)²), multiplied by h² = y² + c_r²,
    which saves the root and the division of each.
    """
    uncovered = max(opening_m, 0.0)
    h2 = uncovered * uncovered + plant.clearance_m * plant.clearance_m
    r = plant.land_k * plant.land_laminar_m2 + plant.land_overlap * max(-opening_m, 0.0) * h2
    return 2.0 * drop_pa * h2 / (r + math.sqrt(r * r + 4.0 * plant.land_k * h2 * abs(drop_pa)))
