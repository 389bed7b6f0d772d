"""The signs of docs/conventions.md, seen on the simulated rig."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from rtcore.channels import CHANNELS
from rtcore.io.simulated import SimulatedIo
from rtcore.memory.segment import private_block
from rtcore.rig.integrate import settle_gas
from rtcore.rig.parameters import rig_from
from rtcore.rig.plant import (
    P_1,
    P_2,
    P_S,
    P_T,
    U_PUMP,
    U_UNIT,
    U_VALVE,
    V_B,
    V_R,
    X_S,
    X_T,
    Y_F,
    Y_V,
)
from rtcore.rig.world import read_world

PERIOD_S = 250e-6


def pushed(inputs: dict[int, float], ticks: int) -> tuple[Any, npt.NDArray[np.float64]]:
    """The plant under constant inputs from rest under full pressure, and its load cell tick by tick."""
    rig = rig_from({"sensors": {"force_noise_n": 0.0, "velocity_noise_m_s": 0.0}})
    world = SimulatedIo(rig, 1, private_block(250_000, seconds=0.01)).world
    core_inputs = np.zeros(
        1, SimulatedIo(rig, 1, private_block(250_000, 0.01)).core["inputs"].dtype
    )[0]
    world["y"][[P_1, P_2]] = 10e6
    world["y"][P_S], world["y"][P_T] = rig.supply.high_pa, rig.supply.tank_pa
    settle_gas(world["plant"], world["y"])
    world["u"][:] = 0.0
    world["u"][U_PUMP] = rig.supply.high_pa
    force = np.empty(ticks)
    for k in range(ticks):
        if k == 400:  # the valve's underlap has settled the pressures
            for index, value in inputs.items():
                world["u"][index] = value
        read_world(world, core_inputs, PERIOD_S)
        force[k] = world["y"][Y_F]
    return world["y"], force


def test_a_positive_valve_command_fills_chamber_1_and_raises_the_force() -> None:
    y, force = pushed({U_VALVE: 0.05}, 2000)
    assert y[X_S] > 0.0
    assert y[P_1] > y[P_2]
    assert force[-1] > 1e3 > abs(force[399])


def test_compression_of_the_chain_is_positive() -> None:
    """The rod pushed towards the unit squeezes what is between them."""
    y, force = pushed({U_VALVE: 0.05}, 2000)
    assert y[9] > y[13] > 0.0  # rod ahead of mass 2, both towards the unit
    assert y[7] < 0.0  # the body is pushed back into the frame
    assert force[-1] > 0.0


def test_a_retreating_unit_lowers_the_force_and_shows_a_positive_velocity() -> None:
    y, force = pushed({U_UNIT: 0.01}, 480)
    assert y[X_T] > 0.0
    assert y[Y_V] > 0.0
    assert y[V_R] - y[V_B] > 0.0
    assert force[-1] < -500.0


@pytest.mark.parametrize("channel", CHANNELS, ids=lambda c: c.name)
def test_a_channel_ends_in_its_unit(channel: Any) -> None:
    suffix = {"N": "_n", "m": "_m", "m/s": "_m_s", "Pa": "_pa", "s": "_s"}.get(channel.unit)
    assert suffix is None or channel.name.endswith(suffix)
    assert channel.doc
