"""The plant's equations of motion, in the order of the oil and then of the force."""

import math

from rtcore.compiled import kernel
from rtcore.rig.fluid import orifice_flow, specific_volume
from rtcore.rig.plant import *  # noqa: F403
from rtcore.rig.servovalve import land_flow, spool_motion


@kernel
def smooth_sign(z):
    """tanh z to 1e-16, absolute, at a third of the library's price."""
    return 1.0 - 2.0 / (math.exp(2.0 * z) + 1.0)


@kernel
def flows(plant, y, u, q):
    """Write the flows and forces `q` at state `y` under inputs `u`."""
    x = y[X_S] + plant.null_m
    q[Q_PA] = land_flow(plant, x + plant.underlap_pa_m, y[P_S] - y[P_1])
    q[Q_AT] = land_flow(plant, -x + plant.underlap_at_m, y[P_1] - y[P_T])
    q[Q_PB] = land_flow(plant, -x + plant.underlap_pb_m, y[P_S] - y[P_2])
    q[Q_BT] = land_flow(plant, x + plant.underlap_bt_m, y[P_2] - y[P_T])
    drop = y[P_1] - y[P_2]
    q[Q_BYPASS] = orifice_flow(drop, plant.bypass_r, plant.bypass_k) + (plant.bypass_linear + plant.leak_m3_s_pa) * drop
    q[Q_DRAIN_1] = plant.drain_1_m3_s_pa * (y[P_1] - plant.drain_pa)
    q[Q_DRAIN_2] = plant.drain_2_m3_s_pa * (y[P_2] - plant.drain_pa)
    q[Q_PUMP] = orifice_flow(max(u[U_PUMP] - y[P_S], 0.0), plant.line_supply_r, plant.line_supply_k)
    q[Q_RELIEF] = plant.relief_m3_s_pa * max(y[P_S] - plant.relief_pa, 0.0)
    q[Q_BLEED] = u[U_BLEED] * orifice_flow(y[P_S] - plant.tank_pa, plant.bleed_r, plant.bleed_k)
    q[Q_TANK] = orifice_flow(y[P_T] - plant.tank_pa, plant.line_return_r, plant.line_return_k)
    slip = y[V_R] - y[V_B]
    q[F_FRICTION] = plant.coulomb_n * smooth_sign(slip / plant.coulomb_m_s) + plant.viscous_n_s_m * slip
    q[F_HYDRAULIC] = plant.area_m2 * drop - q[F_FRICTION]
    q[F_BODY] = plant.k_pl * y[X_B] + plant.c_pl * y[V_B]
    q[F_CELL] = plant.k_lc * (y[X_R] - y[X_1]) + plant.c_lc * (y[V_R] - y[V_1])
    q[F_FIXTURE] = plant.k_2 * (y[X_1] - y[X_2]) + plant.c_2 * (y[V_1] - y[V_2])
    q[F_UNIT] = plant.k_tra * (y[X_2] - y[X_T]) + plant.c_tra * (y[V_2] - y[V_T])


@kernel
def derivatives(plant, y, u, q, dy):
    """Write dy/dt."""
    flows(plant, y, u, q)
    slip = y[V_R] - y[V_B]
    stroke = y[X_R] - y[X_B]

    dy[V_F], dy[X_S] = spool_motion(plant, y[X_F], y[V_F], y[X_S], u[U_VALVE])
    dy[X_F] = y[V_F]

    v_1, slope_1 = specific_volume(plant, y[P_1])
    v_2, slope_2 = specific_volume(plant, y[P_2])
    into_1 = q[Q_PA] - q[Q_AT] - q[Q_BYPASS] - q[Q_DRAIN_1]
    into_2 = q[Q_PB] - q[Q_BT] + q[Q_BYPASS] - q[Q_DRAIN_2]
    volume_1 = plant.volume_1_m3 + plant.area_m2 * stroke
    volume_2 = plant.volume_2_m3 - plant.area_m2 * stroke
    dy[P_1] = -v_1 / (slope_1 * volume_1) * (into_1 * v_1 - plant.area_m2 * slip)
    dy[P_2] = -v_2 / (slope_2 * volume_2) * (into_2 * v_2 + plant.area_m2 * slip)

    into_s = q[Q_PUMP] - q[Q_RELIEF] - q[Q_BLEED] - q[Q_PA] - q[Q_PB]
    if y[P_S] > plant.precharge_supply_pa:
        dy[P_S] = plant.accumulator_n * y[P_S] / y[G_S] * into_s
        dy[G_S] = -into_s
    else:
        dy[P_S] = into_s / plant.hose_m3_pa
        dy[G_S] = 0.0
    into_t = q[Q_AT] + q[Q_BT] - q[Q_TANK]
    dy[P_T] = plant.accumulator_n * y[P_T] / y[G_T] * into_t
    dy[G_T] = -into_t

    dy[X_B], dy[V_B] = y[V_B], (-q[F_HYDRAULIC] - q[F_BODY]) / plant.m_b_kg
    dy[X_R], dy[V_R] = y[V_R], (q[F_HYDRAULIC] - q[F_CELL]) / plant.m_la_kg
    dy[X_1], dy[V_1] = y[V_1], (q[F_CELL] - q[F_FIXTURE]) / plant.m_1_kg
    dy[X_2], dy[V_2] = y[V_2], (q[F_FIXTURE] - q[F_UNIT]) / plant.m_2_kg

    target = min(max(u[U_UNIT], -plant.unit_stroke_m), plant.unit_stroke_m)
    v_ref = plant.omega_t_rad_s / (2.0 * plant.zeta_t) * (target - y[X_T])
    v_ref = min(max(v_ref, -plant.unit_rate_m_s), plant.unit_rate_m_s)
    dy[X_T], dy[V_T] = y[V_T], 2.0 * plant.zeta_t * plant.omega_t_rad_s * (v_ref - y[V_T])

    w = plant.omega_lc_rad_s
    dy[Y_F], dy[DY_F] = y[DY_F], w * w * (q[F_CELL] - y[Y_F]) - 2.0 * plant.zeta_lc * w * y[DY_F]
    dy[Y_V] = plant.omega_lvt_rad_s * (slip - y[Y_V])
