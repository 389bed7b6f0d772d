"""The simulated rig as one record: plant, state, noise, converters, and its slow pump."""

from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Record, kernel
from rtcore.io import SUPPLY_HIGH, SUPPLY_LOW, SUPPLY_OFF
from rtcore.rig.constants import plant_constants
from rtcore.rig.failing import (
    FAILING,
    remember_what_is_right,
    spoil_plant_inputs,
    spoil_sensors,
)
from rtcore.rig.integrate import WORK, advance, settle_gas
from rtcore.rig.noise import NOISE, seed_noise
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import (
    INPUTS,
    P_1,
    P_2,
    P_S,
    P_T,
    PLANT,
    STATES,
    SUBSTEPS,
    U_BLEED,
    U_PUMP,
    U_UNIT,
    U_VALVE,
)
from rtcore.rig.sensors import SENSORS, quantise, read_sensors

WORLD = np.dtype(
    [
        ("plant", PLANT),
        ("sensors", SENSORS),
        ("noise", NOISE),
        ("work", WORK),
        ("y", "f8", (STATES,)),
        ("u", "f8", (INPUTS,)),
        ("held_valve", "f8"),  # the command that the converter will hold from the next tick on
        ("held_unit_m", "f8"),
        ("high_pa", "f8"),
        ("low_pa", "f8"),
        ("ramp_pa_s", "f8"),
        ("failing", FAILING),
    ],
    align=True,
)


def make_world(rig: RigParameters, seed: int) -> npt.NDArray[Any]:
    """(1,) WORLD at rest, supply off, everything at tank pressure."""
    worlds = np.zeros(1, WORLD)
    world = worlds[0]
    world["plant"] = plant_constants(rig)
    half = 2.0 ** (rig.sensors.bits - 1)
    sensors = world["sensors"]
    sensors["half_codes"] = half
    sensors["force_noise_n"] = rig.sensors.force_noise_n
    sensors["velocity_noise_m_s"] = rig.sensors.velocity_noise_m_s
    for lsb, full_scale in (
        ("force_lsb_n", rig.sensors.force_range_n),
        ("velocity_lsb_m_s", rig.sensors.velocity_range_m_s),
        ("displacement_lsb_m", rig.sensors.displacement_range_m),
        ("pressure_lsb_pa", rig.sensors.pressure_range_pa),
        ("valve_lsb", 1.0),
    ):
        sensors[lsb] = full_scale / half
    for name in ("high_pa", "low_pa", "ramp_pa_s"):
        world[name] = getattr(rig.supply, name)
    seed_noise(world["noise"], seed)
    y = world["y"]
    y[[P_1, P_2, P_S, P_T]] = rig.supply.tank_pa
    settle_gas(world["plant"], y)
    world["u"][U_PUMP] = rig.supply.tank_pa
    world["u"][U_BLEED] = 1.0
    remember_what_is_right(world["failing"], world["plant"], sensors)
    return worlds


@kernel
def move_pump(world: Record, supply: int, period_s: float) -> None:
    """The pump's pressure control follows what is asked of it at a limited rate; off opens the bleed valve."""
    target = world.plant.tank_pa
    if supply == SUPPLY_HIGH:
        target = world.high_pa
    elif supply == SUPPLY_LOW:
        target = world.low_pa
    step = world.ramp_pa_s * period_s
    pump = world.u[U_PUMP]
    world.u[U_PUMP] = (
        target if supply == SUPPLY_OFF else pump + min(max(target - pump, -step), step)
    )
    world.u[U_BLEED] = 1.0 if supply == SUPPLY_OFF else 0.0


@kernel
def read_world(world: Record, inputs: Record, period_s: float) -> None:
    """Carry the plant to now under what was held, and read its sensors."""
    failing = world.failing
    force_before_n, velocity_before_m_s = inputs.force_n, inputs.velocity_m_s
    advance(world.plant, world.y, world.u, world.work, period_s, SUBSTEPS)
    read_sensors(world.sensors, world.plant, world.noise, world.y, inputs)
    if failing.present != 0:
        spoil_sensors(failing, world.sensors, inputs, force_before_n, velocity_before_m_s, period_s)


@kernel
def write_world(world: Record, outputs: Record, period_s: float) -> None:
    """Hold the outputs: a command computed in this tick acts from the next one on (one tick of delay)."""
    world.u[U_VALVE] = world.held_valve
    world.u[U_UNIT] = world.held_unit_m
    sensors = world.sensors
    world.held_valve = quantise(outputs.valve_command, sensors.valve_lsb, sensors.half_codes)
    world.held_unit_m = outputs.displacement_command_m
    move_pump(world, outputs.supply, period_s)
    if world.failing.present != 0:
        spoil_plant_inputs(world.failing.amounts, world.plant, world.u)
