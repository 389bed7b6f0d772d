"""From the parameters of a rig to the constants of its kernels."""

import math
from typing import Any

import numpy as np

from rtcore.rig.fluid import tabulate_fluid
from rtcore.rig.parameters import Fluid, RigParameters
from rtcore.rig.plant import PLANT


def fluid_at_temperature(fluid: Fluid) -> dict[str, float]:
    """Density (kg/m³), viscosity (m²/s), bulk modulus (Pa) and free air at the oil's temperature."""
    over = fluid.temperature_c - 40.0
    return {
        "density_kg_m3": fluid.density_kg_m3 * (1.0 - 7.5e-4 * over),
        "viscosity_m2_s": fluid.viscosity_m2_s * math.exp(-0.027 * over),
        "bulk_modulus_pa": fluid.bulk_modulus_pa - 7e6 * over,
        "free_air": fluid.free_air * (1.0 + 0.01 * over),
    }


def plant_constants(rig: RigParameters) -> Any:
    """A PLANT record: every value that the equations of motion need, derived once."""
    plant = np.zeros(1, PLANT)[0]
    oil = fluid_at_temperature(rig.fluid)
    rho, nu = oil["density_kg_m3"], oil["viscosity_m2_s"]
    supply, valve, actuator = rig.supply, rig.servovalve, rig.load_actuator

    for part in (supply, valve, actuator, rig.structure, rig.unit, rig.sensors):
        for name in set(type(part).model_fields) & set(PLANT.names or ()):
            plant[name] = getattr(part, name)

    drop_high = supply.high_pa - supply.tank_pa
    plant["bleed_k"] = drop_high / supply.bleed_m3_s**2
    plant["bleed_r"] = 0.05 * drop_high / supply.bleed_m3_s

    plant["reference_pa"] = rig.fluid.reference_pa
    plant["beta0_pa"] = oil["bulk_modulus_pa"]
    plant["m_beta"] = rig.fluid.bulk_modulus_slope
    plant["alpha"] = oil["free_air"]
    plant["n_air"] = rig.fluid.air_n
    tabulate_fluid(plant)

    plant["k_spool_1_m"] = valve.spool_gain_rad_s / valve.spool_rate_m_s
    plant["spool_stop_k"] = valve.spool_stop_1_s
    plant["land_k"] = rho / (2.0 * (valve.discharge * valve.window_m) ** 2)
    plant["land_laminar_m2"] = valve.transition_reynolds * nu * valve.window_m / 2.0
    plant["land_overlap"] = 12.0 * rho * nu / (valve.window_m * valve.clearance_m**3)

    hole = actuator.bypass_discharge * math.pi * actuator.bypass_diameter_m**2 / 4.0
    plant["bypass_k"] = rho / (2.0 * hole**2)
    laminar = actuator.bypass_transition_reynolds * nu * math.pi * actuator.bypass_diameter_m / 4.0
    plant["bypass_r"] = plant["bypass_k"] * laminar
    plant["bypass_linear"] = actuator.bypass_linear_m3_s_pa

    least_m3 = min(actuator.volume_1_m3, actuator.volume_2_m3)
    plant["end_stop_m"] = (1.0 - actuator.end_cap_share) * least_m3 / actuator.area_m2

    plant["coulomb_s_m"] = 1.0 / actuator.coulomb_m_s
    plant["unit_gain_1_s"] = rig.unit.omega_t_rad_s / (2.0 * rig.unit.zeta_t)
    plant["unit_lag_1_s"] = 2.0 * rig.unit.zeta_t * rig.unit.omega_t_rad_s
    plant["unit_rate_m_s"] = rig.unit.rate_m_s
    plant["unit_stroke_m"] = rig.unit.stroke_m
    return plant


# Linear quantities of the static characteristic (paper eqs 1-3), for analysis and tests.
def valve_flow_gain(rig: RigParameters) -> float:
    """K_sv = C_d w x_s,max √(1/ρ0), m³/s per √Pa at full command."""
    valve = rig.servovalve
    rho = fluid_at_temperature(rig.fluid)["density_kg_m3"]
    return valve.discharge * valve.window_m * valve.spool_stroke_m * math.sqrt(1.0 / rho)


def bypass_flow_gain(rig: RigParameters) -> float:
    """K_o = C_dO (π d_O²/4) √(2/ρ0), m³/s per √Pa."""
    actuator = rig.load_actuator
    rho = fluid_at_temperature(rig.fluid)["density_kg_m3"]
    return (
        actuator.bypass_discharge
        * math.pi
        * actuator.bypass_diameter_m**2
        / 4.0
        * math.sqrt(2.0 / rho)
    )
