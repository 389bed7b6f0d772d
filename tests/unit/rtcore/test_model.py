"""The model that the twin is of: adopted whole while there is no pressure, and followed from then on."""

from typing import Any

import numpy as np
import pytest

from rtcore.codes import Opcode, Reply
from rtcore.memory.commands import post
from rtcore.modes import Mode
from rtcore.rig.model import MODEL, make_model
from rtcore.rig.parameters import rig_from
from rtcore.rig.twin import make_twin, move_twin
from rtcore.virtual import PERIOD_S, Virtual
from tests.unit.rtcore.programs import gains, interlocks
from tests.unit.rtcore.virtual_rigs import LONG

UNTIL_READY = 14_000  # ticks
OTHER = rig_from(
    {
        "supply": {"high_pa": 20e6, "ramp_pa_s": 12e6, "tank_pa": 0.4e6},
        "load_actuator": {"bypass_diameter_m": 1.1e-3, "coulomb_n": 80.0},
        "sensors": {"bits": 14},
    }
)


def with_twin() -> Virtual:
    return Virtual(gains(), interlocks(), twin=True)


def adopt(rig: Virtual, model: Any, bank: int | None = None) -> Reply:
    idle = 1 - int(rig.block.fields["active_model"]) if bank is None else bank
    if 0 <= idle <= 1:
        rig.block.fields["models"][idle] = model
    return rig.command(Opcode.ADOPT_MODEL, idle)


def test_the_twin_follows_the_outputs_as_one_of_the_adopted_parameters_does() -> None:
    rig = with_twin()
    rig.command(Opcode.RESET)
    assert adopt(rig, make_model(OTHER)) == Reply.ACCEPTED
    assert rig.block.fields["active_model"] == 1
    post(rig.block, Opcode.PRESSURISE, now_ns=0, time_to_live_s=1e6)
    beside = make_twin(OTHER)[0]
    found, expected = np.empty(UNTIL_READY), np.empty(UNTIL_READY)
    for i in range(UNTIL_READY):  # the exchange is made in the first of them
        expected[i], _ = move_twin(beside, rig.io.core["outputs"], PERIOD_S)
        rig.advance(1)
        found[i] = rig.block.fields["twin_force_n"]
    assert rig.mode == Mode.READY
    assert np.array_equal(found, expected)
    assert np.std(found[-1000:]) > 0.0  # the loop's noise moves the valve, and that the twin


def test_the_models_own_parameters_change_nothing() -> None:
    plain, again = with_twin(), with_twin()
    own = make_model(rig_from({}))
    assert adopt(again, own) == Reply.ACCEPTED
    plain.advance(again.tick - plain.tick)
    for rig in (plain, again):
        rig.bring_to_ready()
        assert rig.load_program(LONG) == Reply.ACCEPTED
    plain_run, again_run = plain.run(), again.run()
    assert np.array_equal(plain_run["force_n"], again_run["force_n"])
    assert plain.block.fields["twin_force_n"] == again.block.fields["twin_force_n"]


def test_it_is_refused_while_there_is_pressure() -> None:
    rig = with_twin()
    for opcode in (Opcode.RESET, Opcode.PRESSURISE):
        assert rig.command(opcode) == Reply.ACCEPTED
    assert adopt(rig, make_model(OTHER)) == Reply.WRONG_MODE
    rig.advance(20_000)
    assert rig.mode == Mode.READY
    assert adopt(rig, make_model(OTHER)) == Reply.WRONG_MODE
    assert rig.block.fields["active_model"] == 0


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("plant", "m_la_kg"), 0.0),
        (("plant", "area_m2"), -1.0),
        (("plant", "k_lc"), np.nan),
        (("plant", "fluid_table"), np.inf),
        (("rest",), np.nan),
        (("high_pa",), 0.0),
        (("half_codes",), np.nan),
    ],
)
def test_a_model_that_makes_no_sense_is_refused_whole(path: tuple[str, ...], value: float) -> None:
    rig = with_twin()
    wrong = np.array([make_model(OTHER)], MODEL)
    place: Any = wrong
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] = value
    assert adopt(rig, wrong[0]) == Reply.INVALID_BANK
    assert (rig.block.fields["active_model"], rig.io.core["model_due"]) == (0, 0)


@pytest.mark.parametrize("bank", [-1, 2, 2**40])
def test_there_are_two_banks(bank: int) -> None:
    assert adopt(with_twin(), make_model(OTHER), bank) == Reply.INVALID_BANK
