"""Books of oil, energy and momentum over the simulated rig: what it holds, and what passes its borders.

What holds in any motion: what the rig holds more of has come in and not gone out again, nor been turned
into heat. Contents and heat follow from the law of each part, not from the equations of motion, so that
these can be held against them. Oil is counted at reference density (m³). In the chambers it is elastic;
at the manifold it is not, and the gas of the accumulators gives way in its place.
"""

import math

from rtcore.compiled import Array, Record, kernel
from rtcore.rig.fluid import specific_volume_law
from rtcore.rig.plant import (
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
    U_PUMP,
    V_1,
    V_2,
    V_B,
    V_R,
    V_T,
    X_1,
    X_2,
    X_B,
    X_R,
    X_S,
    X_T,
)
from rtcore.rig.servovalve import land_restriction

# What passes, as rates to be integrated: oil (m³/s), power (W), force (N).
OIL_IN, OIL_OUT, ENERGY_IN, ENERGY_OUT, HEAT, IMPULSE, IMPULSE_PASSED = 0, 1, 2, 3, 4, 5, 6
ACCOUNTS = 7


@kernel
def head(plant: Record, pressure_pa: float) -> float:
    """Energy that a reference volume of oil carries (J/m³): h = ∫v dp, equal to the pressure at p_ref."""
    ref, m, n = plant.reference_pa, plant.m_beta, plant.n_air
    base = (plant.beta0_pa + m * (pressure_pa - ref)) / plant.beta0_pa
    if m == 1.0:
        liquid = plant.beta0_pa * math.log(base)
    else:
        liquid = plant.beta0_pa / (m - 1.0) * (base ** (1.0 - 1.0 / m) - 1.0)
    if n == 1.0:
        air = ref * math.log(pressure_pa / ref)
    else:
        air = ref * n / (n - 1.0) * ((pressure_pa / ref) ** (1.0 - 1.0 / n) - 1.0)
    return ref + (1.0 - plant.alpha) * liquid + plant.alpha * air


@kernel
def _chamber(plant: Record, pressure_pa: float, volume_m3: float) -> tuple[float, float]:
    """(oil, energy): the elastic energy of a reference volume is h - p v."""
    v, _ = specific_volume_law(plant, pressure_pa)
    oil = volume_m3 / v
    return oil, oil * head(plant, pressure_pa) - pressure_pa * volume_m3


@kernel
def _gas(pressure_pa: float, gas_m3: float, n: float, precharge_pa: float, all_m3: float) -> float:
    """Energy (J) of an accumulator's gas: -∫p dV along p V^n."""
    if n == 1.0:
        return precharge_pa * all_m3 * math.log(all_m3 / gas_m3)
    return (pressure_pa * gas_m3 - precharge_pa * all_m3) / (n - 1.0)


@kernel
def contents(plant: Record, y: Array) -> tuple[float, float, float]:
    """(oil m³, energy J, momentum N s) that the rig holds in a state."""
    stroke = plant.area_m2 * (y[X_R] - y[X_B])
    oil_1, energy_1 = _chamber(plant, y[P_1], plant.volume_1_m3 + stroke)
    oil_2, energy_2 = _chamber(plant, y[P_2], plant.volume_2_m3 - stroke)
    hose_pa = min(y[P_S], plant.precharge_supply_pa)  # gas takes over from the hoses at precharge
    n, all_s, all_t = plant.accumulator_n, plant.accumulator_supply_m3, plant.accumulator_return_m3
    full_hoses = plant.hose_m3_pa * plant.precharge_supply_pa
    oil = oil_1 + oil_2 + full_hoses + (all_s - y[G_S]) + (all_t - y[G_T])

    energy = energy_1 + energy_2 + 0.5 * plant.hose_m3_pa * hose_pa * hose_pa
    if y[P_S] > plant.precharge_supply_pa:
        energy += _gas(y[P_S], y[G_S], n, plant.precharge_supply_pa, all_s)
    energy += _gas(y[P_T], y[G_T], n, plant.precharge_return_pa, all_t)
    for k, compression in (
        (plant.k_pl, y[X_B]),
        (plant.k_lc, y[X_R] - y[X_1]),
        (plant.k_2, y[X_1] - y[X_2]),
        (plant.k_tra, y[X_2] - y[X_T]),
    ):
        energy += 0.5 * k * compression * compression
    depth = max(0.0, abs(y[X_R] - y[X_B]) - plant.end_stop_m)
    energy += 0.5 * plant.end_stop_n_m * depth * depth
    momentum = 0.0
    for mass, velocity in (
        (plant.m_b_kg, y[V_B]),
        (plant.m_la_kg, y[V_R]),
        (plant.m_1_kg, y[V_1]),
        (plant.m_2_kg, y[V_2]),
    ):
        energy += 0.5 * mass * velocity * velocity
        momentum += mass * velocity
    return oil, energy, momentum


@kernel
def _land_heat(plant: Record, opening_m: float, flow: float) -> float:
    h2, r_h2 = land_restriction(plant, opening_m)
    return (r_h2 + plant.land_k * abs(flow)) / h2 * flow * flow


@kernel
def oil_heat(plant: Record, y: Array, q: Array) -> float:
    """Power (W) that the oil loses in restrictions: (r + k|Q|) Q² each, or Q²/g where laminar."""
    x = y[X_S] + plant.null_m
    drop = y[P_1] - y[P_2]
    laminar = (plant.bypass_linear + plant.leak_m3_s_pa) * drop
    through = q[Q_BYPASS] - laminar
    heat = laminar * drop
    heat += _land_heat(plant, x + plant.underlap_pa_m, q[Q_PA])
    heat += _land_heat(plant, -x + plant.underlap_at_m, q[Q_AT])
    heat += _land_heat(plant, -x + plant.underlap_pb_m, q[Q_PB])
    heat += _land_heat(plant, x + plant.underlap_bt_m, q[Q_BT])
    for r, k, flow in (
        (plant.bypass_r, plant.bypass_k, through),
        (plant.line_supply_r, plant.line_supply_k, q[Q_PUMP]),
        (plant.line_return_r, plant.line_return_k, q[Q_TANK]),
    ):
        heat += (r + k * abs(flow)) * flow * flow
    heat += plant.drain_1_m3_s_pa * (y[P_1] - plant.drain_pa) ** 2
    heat += plant.drain_2_m3_s_pa * (y[P_2] - plant.drain_pa) ** 2
    # Relief and bleed throw away all the pressure that they find.
    return heat + (q[Q_RELIEF] + q[Q_BLEED]) * (y[P_S] - plant.tank_pa)


@kernel
def _end_stop_heat(plant: Record, stroke_m: float, slip_m_s: float) -> float:
    """What the end cap takes more on the way in than it gives back on the way out."""
    depth = max(0.0, abs(stroke_m) - plant.end_stop_m)
    inward = slip_m_s if stroke_m > 0.0 else -slip_m_s
    extra = max(-1.0, plant.end_stop_s_m * inward)
    return plant.end_stop_n_m * depth * extra * inward


@kernel
def solid_heat(plant: Record, y: Array) -> float:
    """Power (W) lost in friction and dampers."""
    slip = y[V_R] - y[V_B]
    heat = (
        plant.coulomb_n * math.tanh(slip * plant.coulomb_s_m) + plant.viscous_n_s_m * slip
    ) * slip
    for c, rate in (
        (plant.c_pl, y[V_B]),
        (plant.c_lc, y[V_R] - y[V_1]),
        (plant.c_2, y[V_1] - y[V_2]),
        (plant.c_tra, y[V_2] - y[V_T]),
    ):
        heat += c * rate * rate
    return heat + _end_stop_heat(plant, y[X_R] - y[X_B], slip)


@kernel
def keep_books(plant: Record, y: Array, u: Array, q: Array, rates: Array) -> None:
    """Write (ACCOUNTS,) `rates` at state `y` under inputs `u`, with the flows `q` that are there."""
    drained = q[Q_DRAIN_1] + q[Q_DRAIN_2]
    to_tank = q[Q_RELIEF] + q[Q_BLEED] + q[Q_TANK]
    rates[OIL_IN] = q[Q_PUMP]
    rates[OIL_OUT] = drained + to_tank

    # Oil that enters a chamber becomes elastic on its way: it is squeezed by its neighbours.
    into_1 = q[Q_PA] - q[Q_AT] - q[Q_BYPASS] - q[Q_DRAIN_1]
    into_2 = q[Q_PB] - q[Q_BT] + q[Q_BYPASS] - q[Q_DRAIN_2]
    squeezed = into_1 * (head(plant, y[P_1]) - y[P_1]) + into_2 * (head(plant, y[P_2]) - y[P_2])
    unit_n = plant.k_tra * (y[X_2] - y[X_T]) + plant.c_tra * (y[V_2] - y[V_T])
    plate_n = plant.k_pl * y[X_B] + plant.c_pl * y[V_B]
    rates[ENERGY_IN] = q[Q_PUMP] * u[U_PUMP] + squeezed
    rates[ENERGY_OUT] = drained * plant.drain_pa + to_tank * plant.tank_pa + unit_n * y[V_T]
    rates[HEAT] = oil_heat(plant, y, q) + solid_heat(plant, y)
    rates[IMPULSE] = -plate_n - unit_n
    rates[IMPULSE_PASSED] = abs(plate_n) + abs(unit_n)
