"""The model of the rig that the twin is of: what the app may put in force while there is no pressure."""

from typing import Any

import numpy as np

from rtcore.compiled import Record, carray, kernel, offset_of, pointer
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import PLANT, STATES, U_BLEED, U_PUMP
from rtcore.rig.world import WORLD, make_world

MODEL = np.dtype(
    [
        ("plant", PLANT),
        ("rest", "f8", (STATES,)),  # the state at tank pressure
        ("high_pa", "f8"),
        ("low_pa", "f8"),
        ("ramp_pa_s", "f8"),
        ("tank_pa", "f8"),
        ("valve_lsb", "f8"),
        ("half_codes", "f8"),
    ],
    align=True,
)
_WORDS = MODEL.itemsize // 8
_PLANT_WORDS = PLANT.itemsize // 8
_PLANT_OF_MODEL = offset_of(MODEL, "plant")
_PLANT_OF_WORLD = offset_of(WORLD, "plant")


def make_model(rig: RigParameters) -> Any:
    """A MODEL record, () of its dtype."""
    world, model = make_world(rig, seed=0)[0], np.zeros((), MODEL)
    model["plant"], model["rest"] = world["plant"], world["y"]
    for name in ("high_pa", "low_pa", "ramp_pa_s"):
        model[name] = world[name]
    model["tank_pa"] = rig.supply.tank_pa
    model["valve_lsb"] = world["sensors"]["valve_lsb"]
    model["half_codes"] = world["sensors"]["half_codes"]
    return model


@kernel
def model_is_valid(model_address: int) -> bool:
    """Whether a twin may be of this model: finite all through, and nothing without mass, area or pressure."""
    words = carray(pointer(model_address), _WORDS, np.float64)
    for i in range(_WORDS):
        if not np.isfinite(words[i]):
            return False
    model = carray(pointer(model_address), 1, MODEL)[0]
    plant = model.plant
    for value in (
        plant.m_b_kg,
        plant.m_la_kg,
        plant.m_1_kg,
        plant.m_2_kg,
        plant.area_m2,
        plant.volume_1_m3,
        plant.volume_2_m3,
        plant.spool_stroke_m,
        model.tank_pa,
        model.low_pa,
        model.high_pa,
        model.ramp_pa_s,
        model.valve_lsb,
        model.half_codes,
    ):
        if not value > 0.0:
            return False
    return True


@kernel
def put_at_rest(world: Record, model: Record) -> None:
    """Everything of a world besides its plant: at tank pressure, with nothing held."""
    world.y[:] = model.rest
    world.u[:] = 0.0
    world.u[U_PUMP] = model.tank_pa
    world.u[U_BLEED] = 1.0
    world.held_valve = 0.0
    world.held_unit_m = 0.0
    world.high_pa = model.high_pa
    world.low_pa = model.low_pa
    world.ramp_pa_s = model.ramp_pa_s
    world.sensors.valve_lsb = model.valve_lsb
    world.sensors.half_codes = model.half_codes
    world.work.finer_ticks = 0


@kernel
def adopt_model(twin_address: int, model_address: int) -> None:
    """Make the twin one of this model, at rest."""
    source = carray(pointer(model_address + _PLANT_OF_MODEL), _PLANT_WORDS, np.int64)
    target = carray(pointer(twin_address + _PLANT_OF_WORLD), _PLANT_WORDS, np.int64)
    for i in range(_PLANT_WORDS):
        target[i] = source[i]
    twin = carray(pointer(twin_address), 1, WORLD)[0]
    put_at_rest(twin, carray(pointer(model_address), 1, MODEL)[0])
