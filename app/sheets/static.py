"""The static characteristic and force gain against the valve command, for any bypass orifice (figure 5)."""

import numpy as np

from app.analysis.static import Floats, bypass_flow, force_gain, load_pressure, static_force
from app.sheets.asked import StaticAsked
from app.sheets.curves import curve
from app.sheets.schemas import OrificeCurves, StaticSheet
from rtcore.rig.parameters import RigParameters


def static_sheet(rig: RigParameters, asked: StaticAsked) -> StaticSheet:
    """A curve for each orifice, over the whole stroke of the valve."""
    has = rig.load_actuator.bypass_diameter_m
    pressure = asked.pressure_pa or rig.supply.high_pa - rig.supply.tank_pa
    command = np.linspace(-1.0, 1.0, asked.points)
    return StaticSheet(
        pressure_pa=pressure,
        in_force_diameter_m=has,
        valve_command=curve(command),
        orifices=[
            _curves(with_orifice(rig, diameter), command, pressure)
            for diameter in asked.orifice_diameter_m or (has,)
        ],
    )


def with_orifice(rig: RigParameters, diameter_m: float) -> RigParameters:
    """The rig with another bypass orifice."""
    actuator = rig.load_actuator.model_copy(update={"bypass_diameter_m": diameter_m})
    return rig.model_copy(update={"load_actuator": actuator})


def _curves(rig: RigParameters, command: Floats, pressure_pa: float) -> OrificeCurves:
    return OrificeCurves(
        orifice_diameter_m=rig.load_actuator.bypass_diameter_m,
        load_pressure_pa=curve(load_pressure(rig, command, pressure_pa)),
        force_n=curve(static_force(rig, command, pressure_pa)),
        force_gain_n=curve(force_gain(rig, command, pressure_pa)),
        bypass_flow_m3_s=curve(bypass_flow(rig, command, pressure_pa)),
    )
