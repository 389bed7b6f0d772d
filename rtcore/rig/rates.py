"""How fast the fastest part of a rig moves: the integrator follows only so much."""

import math
from typing import TYPE_CHECKING

import numpy as np

from rtcore.rig.plant import SUBSTEPS

if TYPE_CHECKING:
    from rtcore.rig.parameters import RigParameters

# Runge-Kutta's limit is 2.78 a step. Restrictions may be faster near no drop: they tremble there, where a
# structure would fly apart.
FASTEST_1_S = 2.6 * SUBSTEPS / 250e-6
STEPS_AT_STOP = 6  # that the valve takes for one of the rest


def smallest_chambers(rig: "RigParameters") -> tuple[float, float]:
    """Volumes (m³) of chambers 1 and 2 where the unit's stroke leaves least of each."""
    taken = rig.load_actuator.area_m2 * rig.unit.stroke_m
    return rig.load_actuator.volume_1_m3 - taken, rig.load_actuator.volume_2_m3 - taken


def fastest_part(rig: "RigParameters") -> tuple[str, float]:
    """Which part moves fastest, and the largest magnitude of its eigenvalues (1/s)."""
    valve, sensors = rig.servovalve, rig.sensors
    stop_rad_s = valve.omega_f_rad_s * math.sqrt(1.0 + valve.flapper_stop_k)
    stop_damping = valve.zeta_f * (1.0 + valve.flapper_stop_c) * valve.omega_f_rad_s / stop_rad_s
    rates = {
        "structure": structure_rate(rig),
        "piston on its end stop": end_stop_rate(rig),
        "servovalve's flapper": second_order_rate(valve.omega_f_rad_s, valve.zeta_f),
        "flapper's stop": second_order_rate(stop_rad_s, stop_damping) / STEPS_AT_STOP,
        "load cell's chain": second_order_rate(sensors.omega_lc_rad_s, sensors.zeta_lc),
        "LVT's chain": sensors.omega_lvt_rad_s,
    }
    return max(rates.items(), key=lambda item: item[1])


def second_order_rate(omega_rad_s: float, zeta: float) -> float:
    """Of s² + 2ζωs + ω²."""
    return omega_rad_s * (zeta + math.sqrt(zeta * zeta - 1.0) if zeta > 1.0 else 1.0)


def end_stop_rate(rig: "RigParameters") -> float:
    """Of the rod between its load cell and the end cap."""
    stiffness = rig.load_actuator.end_stop_n_m + rig.structure.k_lc
    return math.sqrt(stiffness / rig.structure.m_la_kg)


def structure_rate(rig: "RigParameters") -> float:
    """Of bodies, springs and dampers, and the oil between body and rod."""
    s, unit, actuator, fluid = rig.structure, rig.unit, rig.load_actuator, rig.fluid
    bulk_pa = fluid.bulk_modulus_pa + fluid.bulk_modulus_slope * rig.supply.high_pa
    softness = 1.0 / actuator.volume_1_m3 + 1.0 / actuator.volume_2_m3
    oil_k = actuator.area_m2**2 * bulk_pa * softness
    # Each joins the body before it to the one after it; the first and the last stand on the ground.
    joints = (
        (s.k_pl, s.c_pl),
        (oil_k, actuator.viscous_n_s_m),
        (s.k_lc, s.c_lc),
        (s.k_2, s.c_2),
        (unit.k_tra, unit.c_tra),
    )
    stretch = np.eye(5, 4) - np.eye(5, 4, -1)  # of each joint, by the displacement of each body
    stiffness, damping = (
        stretch.T @ np.diag([joint[i] for joint in joints]) @ stretch for i in (0, 1)
    )
    mass = np.array([s.m_b_kg, s.m_la_kg, s.m_1_kg, s.m_2_kg])
    motion = np.zeros((8, 8))
    motion[:4, 4:] = np.eye(4)
    motion[4:, :4] = -stiffness / mass[:, None]
    motion[4:, 4:] = -damping / mass[:, None]
    return float(np.max(np.abs(np.linalg.eigvals(motion))))
