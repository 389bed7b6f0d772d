"""The plant's equations of motion, in the order of the oil and then of the force."""

import math

from rtcore.compiled import Array, Record, inlined
from rtcore.lanes import divide4
from rtcore.rig.fluid import specific_volume
from rtcore.rig.plant import (
    DY_F,
    F_BODY,
    F_CELL,
    F_FIXTURE,
    F_FRICTION,
    F_HYDRAULIC,
    F_UNIT,
    G_S,
    G_T,
    P_1,
    P_2,
    P_S,
    P_T,
    Q_AT,
    Q_BLEED,
    Q_BT,
    Q_BYPASS,
    Q_DRAIN_1,
    Q_DRAIN_2,
    Q_PA,
    Q_PB,
    Q_PUMP,
    Q_RELIEF,
    Q_TANK,
    U_BLEED,
    U_PUMP,
    U_UNIT,
    U_VALVE,
    V_1,
    V_2,
    V_B,
    V_F,
    V_R,
    V_T,
    X_1,
    X_2,
    X_B,
    X_F,
    X_R,
    X_S,
    X_T,
    Y_F,
    Y_V,
)
from rtcore.rig.restriction import flows4
from rtcore.rig.servovalve import land_flows, spool_motion


@inlined
def smooth_sign(z: float) -> float:
    """tanh z to 1e-16, absolute, at a third of the library's price."""
    return 1.0 - 2.0 / (math.exp(2.0 * z) + 1.0)


@inlined
def end_stop_force(plant: Record, stroke_m: float, slip_m_s: float) -> float:
    """Force (N) of an end cap on the piston, by Hunt and Crossley: stiffer on the way in; it never pulls."""
    depth = abs(stroke_m) - plant.end_stop_m
    if not depth > 0.0:
        return 0.0
    side = math.copysign(1.0, stroke_m)
    return -side * plant.end_stop_n_m * depth * max(0.0, 1.0 + plant.end_stop_s_m * slip_m_s * side)


@inlined
def flows(plant: Record, y: Array, x_s: float, u: Array, q: Array) -> None:
    """Write the flows and forces `q` at state `y`, with the spool at `x_s` (m), under inputs `u`."""
    q[Q_PA], q[Q_AT], q[Q_PB], q[Q_BT] = land_flows(plant, x_s, y[P_S], y[P_1], y[P_2], y[P_T])
    drop = y[P_1] - y[P_2]
    through, pumped, bled, returned = flows4(
        drop, max(u[U_PUMP] - y[P_S], 0.0), y[P_S] - plant.tank_pa, y[P_T] - plant.tank_pa,
        plant.bypass_r, plant.line_supply_r, plant.bleed_r, plant.line_return_r,
        plant.bypass_k, plant.line_supply_k, plant.bleed_k, plant.line_return_k,
    )  # fmt: skip
    q[Q_BYPASS] = through + (plant.bypass_linear + plant.leak_m3_s_pa) * drop
    q[Q_DRAIN_1] = plant.drain_1_m3_s_pa * (y[P_1] - plant.drain_pa)
    q[Q_DRAIN_2] = plant.drain_2_m3_s_pa * (y[P_2] - plant.drain_pa)
    q[Q_PUMP] = pumped
    q[Q_RELIEF] = plant.relief_m3_s_pa * max(y[P_S] - plant.relief_pa, 0.0)
    q[Q_BLEED] = u[U_BLEED] * bled
    q[Q_TANK] = returned
    slip = y[V_R] - y[V_B]
    q[F_FRICTION] = (
        plant.coulomb_n * smooth_sign(slip * plant.coulomb_s_m) + plant.viscous_n_s_m * slip
    )
    stop = end_stop_force(plant, y[X_R] - y[X_B], slip)
    q[F_HYDRAULIC] = plant.area_m2 * drop - q[F_FRICTION] + stop
    q[F_BODY] = plant.k_pl * y[X_B] + plant.c_pl * y[V_B]
    q[F_CELL] = plant.k_lc * (y[X_R] - y[X_1]) + plant.c_lc * (y[V_R] - y[V_1])
    q[F_FIXTURE] = plant.k_2 * (y[X_1] - y[X_2]) + plant.c_2 * (y[V_1] - y[V_2])
    q[F_UNIT] = plant.k_tra * (y[X_2] - y[X_T]) + plant.c_tra * (y[V_2] - y[V_T])


@inlined
def rig_derivatives(plant: Record, y: Array, x_s: float, u: Array, q: Array, dy: Array) -> None:
    """Write dy/dt of everything behind the spool, which itself moves `x_s` and depends on none of it."""
    flows(plant, y, x_s, u, q)
    slip = y[V_R] - y[V_B]
    stroke = y[X_R] - y[X_B]

    v_1, slope_1 = specific_volume(plant, y[P_1])
    v_2, slope_2 = specific_volume(plant, y[P_2])
    into_1 = q[Q_PA] - q[Q_AT] - q[Q_BYPASS] - q[Q_DRAIN_1]
    into_2 = q[Q_PB] - q[Q_BT] + q[Q_BYPASS] - q[Q_DRAIN_2]
    into_s = q[Q_PUMP] - q[Q_RELIEF] - q[Q_BLEED] - q[Q_PA] - q[Q_PB]
    into_t = q[Q_AT] + q[Q_BT] - q[Q_TANK]
    volume_1 = plant.volume_1_m3 + plant.area_m2 * stroke
    volume_2 = plant.volume_2_m3 - plant.area_m2 * stroke
    charged = y[P_S] > plant.precharge_supply_pa
    dy[P_1], dy[P_2], dy[P_S], dy[P_T] = divide4(
        -v_1 * (into_1 * v_1 - plant.area_m2 * slip),  # β/V = -v/(v' V)
        -v_2 * (into_2 * v_2 + plant.area_m2 * slip),
        plant.accumulator_n * y[P_S] * into_s if charged else into_s,
        plant.accumulator_n * y[P_T] * into_t,
        slope_1 * volume_1,
        slope_2 * volume_2,
        y[G_S] if charged else plant.hose_m3_pa,
        y[G_T],
    )
    dy[G_S] = -into_s
    dy[G_T] = -into_t

    dy[X_B], dy[X_R], dy[X_1], dy[X_2] = y[V_B], y[V_R], y[V_1], y[V_2]
    dy[V_B], dy[V_R], dy[V_1], dy[V_2] = divide4(
        -q[F_HYDRAULIC] - q[F_BODY], q[F_HYDRAULIC] - q[F_CELL], q[F_CELL] - q[F_FIXTURE], q[F_FIXTURE] - q[F_UNIT],
        plant.m_b_kg, plant.m_la_kg, plant.m_1_kg, plant.m_2_kg,
    )  # fmt: skip

    target = min(max(u[U_UNIT], -plant.unit_stroke_m), plant.unit_stroke_m)
    v_ref = plant.unit_gain_1_s * (target - y[X_T])
    v_ref = min(max(v_ref, -plant.unit_rate_m_s), plant.unit_rate_m_s)
    dy[X_T], dy[V_T] = y[V_T], plant.unit_lag_1_s * (v_ref - y[V_T])

    w = plant.omega_lc_rad_s
    dy[Y_F], dy[DY_F] = y[DY_F], w * w * (q[F_CELL] - y[Y_F]) - 2.0 * plant.zeta_lc * w * y[DY_F]
    dy[Y_V] = plant.omega_lvt_rad_s * (slip - y[Y_V])


@inlined
def derivatives(plant: Record, y: Array, u: Array, q: Array, dy: Array) -> None:
    """Write dy/dt of the whole plant."""
    dy[X_F] = y[V_F]
    dy[V_F], dy[X_S] = spool_motion(plant, y[X_F], y[V_F], y[X_S], u[U_VALVE])
    rig_derivatives(plant, y, y[X_S], u, q, dy)
