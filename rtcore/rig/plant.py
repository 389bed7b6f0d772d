"""What the kernels of the rig share: the constants of the plant, its state and its flows.

The constants are derived once from `RigParameters`; nothing in the tick divides two parameters.
Signs: force and displacement grow from the load actuator (LA) towards the unit under test (TRA).
"""

import numpy as np

# State vector, (STATES,) float64. Chain: frame – body – (oil) – rod – load cell – m1 – m2 – unit.
X_F, V_F = 0, 1  # flapper, share of its travel; its rate (1/s)
X_S = 2  # spool (m)
P_1, P_2 = 3, 4  # chamber pressures (Pa, absolute)
P_S, P_T = 5, 6  # supply and return at the manifold (Pa, absolute)
X_B, V_B = 7, 8  # LA body (m, m/s)
X_R, V_R = 9, 10  # LA rod
X_1, V_1 = 11, 12  # mass 1
X_2, V_2 = 13, 14  # mass 2
X_T, V_T = 15, 16  # the unit's own output
Y_F, DY_F = 17, 18  # load cell's chain, output (N) and its rate (N/s)
Y_V = 19  # LVT's chain, output (m/s)
G_S, G_T = (
    20,
    21,
)  # gas of the accumulators (m³), supply and return; what the hoses lack counts as gas
STATES = 22

SUBSTEPS = 3  # steps of the integrator in a tick, at least

# Inputs of the plant, held over a tick, (INPUTS,) float64.
U_VALVE, U_UNIT, U_PUMP, U_BLEED = 0, 1, 2, 3
INPUTS = (
    4  # valve command (-), unit's position command (m), pump pressure (Pa), bleed valve open (0/1)
)

# Flows (m³/s at reference density) and forces (N), (FLOWS,) float64, kept for the balances.
Q_PA, Q_AT, Q_PB, Q_BT, Q_BYPASS, Q_DRAIN_1, Q_DRAIN_2 = 0, 1, 2, 3, 4, 5, 6
Q_PUMP, Q_RELIEF, Q_BLEED, Q_TANK = 7, 8, 9, 10
F_HYDRAULIC, F_FRICTION, F_BODY, F_CELL, F_FIXTURE, F_UNIT = 11, 12, 13, 14, 15, 16
FLOWS = 17

FLUID_POINTS = 4097
FLUID_STEP_PA = 1e4

PLANT = np.dtype(
    [
        *(
            (name, "f8")
            for name in (
            # supply
            "line_supply_r", "line_supply_k", "line_return_r", "line_return_k",
            "accumulator_supply_m3", "precharge_supply_pa", "accumulator_return_m3", "precharge_return_pa",
            "accumulator_n", "hose_m3_pa", "tank_pa", "relief_pa", "relief_m3_s_pa", "bleed_r", "bleed_k",
            # fluid
            "reference_pa", "beta0_pa", "m_beta", "alpha", "n_air",
            # servovalve
            "omega_f_rad_s", "zeta_f", "flapper_stop_k", "flapper_stop_c", "k_spool_1_m", "spool_rate_m_s",
            "spool_stroke_m", "spool_stop_k", "null_m", "clearance_m",
            "underlap_pa_m", "underlap_at_m", "underlap_pb_m", "underlap_bt_m",
            "land_k", "land_laminar_m2", "land_overlap",
            # load actuator
            "area_m2", "volume_1_m3", "volume_2_m3", "bypass_r", "bypass_k", "bypass_linear",
            "leak_m3_s_pa", "drain_1_m3_s_pa", "drain_2_m3_s_pa", "drain_pa",
            "coulomb_n", "coulomb_s_m", "viscous_n_s_m", "end_stop_m", "end_stop_n_m", "end_stop_s_m",
            # structure
            "m_b_kg", "m_la_kg", "m_1_kg", "m_2_kg", "k_pl", "c_pl", "k_lc", "c_lc", "k_2", "c_2",
            # unit under test
            "k_tra", "c_tra", "unit_gain_1_s", "unit_lag_1_s", "unit_rate_m_s", "unit_stroke_m",
            # sensors
            "omega_lc_rad_s", "zeta_lc", "omega_lvt_rad_s",
        )
        ),
        ("fluid_table", "f8", (FLUID_POINTS, 2)),  # v and dv/dp times the step, see rtcore.rig.fluid
    ],
    align=True,
)  # fmt: skip
