"""A supply that fails, on the virtual clock, with the interlocks as shipped."""

import numpy as np
import pytest

from app.controller import record as controller
from app.controller.settings import ControllerSettings
from app.interlocks import record as interlocks
from app.interlocks.defaults import default_interlocks
from rtcore.codes import Opcode, Reply
from rtcore.modes import Mode
from rtcore.virtual import PERIOD_S, Virtual


@pytest.fixture
def rig() -> Virtual:
    return Virtual(
        controller.to_record(ControllerSettings()),
        interlocks.to_record(default_interlocks(), PERIOD_S),
    )


def tripped_by(rig: Virtual) -> str:
    return default_interlocks().detectors[int(rig.block.fields["first_out"])].name


def test_a_pump_that_does_not_reach_its_pressure_is_given_up(rig: Virtual) -> None:
    rig.io.world["high_pa"] = 15e6
    rig.command(Opcode.RESET)
    rig.command(Opcode.PRESSURISE)
    records = rig.advance(round(16.0 / PERIOD_S))
    given_up = int(np.argmax(records["mode"] == Mode.TRIPPED))
    assert given_up * PERIOD_S == pytest.approx(15.0, abs=0.01)
    assert tripped_by(rig) == "slow_pressure"
    assert records["supply_pressure_pa"].max() < 15.1e6


def test_a_pump_that_fails_trips_once_the_accumulator_is_down(rig: Virtual) -> None:
    rig.bring_to_ready()
    rig.io.world["high_pa"] = 0.3e6
    records = rig.advance(round(20.0 / PERIOD_S))
    assert rig.mode == Mode.TRIPPED
    assert tripped_by(rig) == "supply_pressure"
    assert not records["valve_command"][records["mode"] == Mode.TRIPPED].any()


def test_a_sensor_that_is_dead_before_the_start_blocks_the_reset(rig: Virtual) -> None:
    rig.io.world["sensors"]["force_noise_n"] = 0.0  # frozen to the last bit
    rig.advance(1000)
    assert tripped_by(rig) == "load_cell"
    assert rig.command(Opcode.RESET) == Reply.CAUSE_PRESENT
    assert rig.mode == Mode.TRIPPED
