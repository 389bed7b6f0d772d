"""The servovalve: first stage, spool with its electronics, and the four metering lands."""

import math

from rtcore.compiled import Four, Record, inlined
from rtcore.rig.restriction import flows4

CURRENT_LIMIT = 1.5  # of the torque motor, as a share of the flapper's travel


@inlined
def flapper_stop(plant: Record, x_f: float, v_f: float) -> float:
    """Acceleration (1/s²) by which a stop at ±1 pushes the flapper back; it never pulls."""
    depth = abs(x_f) - 1.0
    if not depth > 0.0:
        return 0.0
    side = math.copysign(1.0, x_f)
    wf = plant.omega_f_rad_s
    spring = wf * wf * plant.flapper_stop_k * depth
    damper = 2.0 * plant.zeta_f * wf * plant.flapper_stop_c * v_f * side * min(50.0 * depth, 1.0)
    return side * max(0.0, spring + damper)


@inlined
def spool_motion(
    plant: Record, x_f: float, v_f: float, x_s: float, command: float
) -> tuple[float, float]:
    """(flapper acceleration, spool velocity) for a valve command of -1…+1."""
    wf = plant.omega_f_rad_s
    error = plant.k_spool_1_m * (command * plant.spool_stroke_m - x_s)
    current = min(max(error, -CURRENT_LIMIT), CURRENT_LIMIT)
    flapper = (
        wf * wf * (current - x_f) - 2.0 * plant.zeta_f * wf * v_f - flapper_stop(plant, x_f, v_f)
    )
    beyond = max(x_s - plant.spool_stroke_m, 0.0) - max(-x_s - plant.spool_stroke_m, 0.0)
    return flapper, plant.spool_rate_m_s * x_f - plant.spool_stop_k * beyond


@inlined
def land_restriction(plant: Record, opening_m: float) -> tuple[float, float]:
    """(h², r h²) of a land: an orifice of width w and height h = √(y² + c_r²), with Reynolds-dependent C_d.

    r = k Re_tr ν w/2 + 12 ρ0 ν max(-y, 0)/(w c_r³) with k = ρ0/(2 (C_d w h)²): the laminar part of the
    discharge law C_d √(Re/(Re + Re_tr)), and of the gap where the land overlaps.
    """
    uncovered = max(opening_m, 0.0)
    h2 = uncovered * uncovered + plant.clearance_m * plant.clearance_m
    return h2, plant.land_k * plant.land_laminar_m2 + plant.land_overlap * max(-opening_m, 0.0) * h2


@inlined
def land_flows(plant: Record, x_s: float, p_s: float, p_1: float, p_2: float, p_t: float) -> Four:
    """Flows (m³/s) P→A, A→T, P→B, B→T at a spool position (m) and four pressures (Pa).

    Root and drop are multiplied by h², which saves dividing by it: (r h²)² + 4 (k h²) h² |Δp|/h² and so on.
    """
    x = x_s + plant.null_m
    h_pa, r_pa = land_restriction(plant, x + plant.underlap_pa_m)
    h_at, r_at = land_restriction(plant, -x + plant.underlap_at_m)
    h_pb, r_pb = land_restriction(plant, -x + plant.underlap_pb_m)
    h_bt, r_bt = land_restriction(plant, x + plant.underlap_bt_m)
    k = plant.land_k
    return flows4(
        h_pa * (p_s - p_1), h_at * (p_1 - p_t), h_pb * (p_s - p_2), h_bt * (p_2 - p_t),
        r_pa, r_at, r_pb, r_bt,
        k, k, k, k,
    )  # fmt: skip
