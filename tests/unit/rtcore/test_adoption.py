"""Commands and banks: what the loop takes over, and what it refuses whole."""

from typing import Any

import numpy as np
import pytest

from rtcore.codes import Opcode, Reply
from rtcore.interlocks import Action, Form, Quantity
from rtcore.memory.commands import post
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    HOLD_ROW,
    PERIOD_S,
    Row,
    detector,
    gains,
    interlocks,
    program,
)
from tests.unit.rtcore.virtual_rigs import LONG, make, reply_to


def test_nothing_is_adopted_during_a_run(running: Virtual) -> None:
    for opcode in (Opcode.ADOPT_GAINS, Opcode.ADOPT_INTERLOCKS):
        assert running.command(opcode, 1) == Reply.WRONG_MODE
    assert running.load_program(LONG) == Reply.WRONG_MODE


@pytest.mark.parametrize(
    "row",
    [
        {"kind": 9},
        {"kind": 2, "target": 60e3, "ticks": 10},
        {"kind": 2, "target": np.nan, "ticks": 10},
        {"kind": 3, "target": np.nan, "ticks": 10},
        {"kind": 2, "target": 1e3, "rate_per_s": 0.0},
        {"kind": 2, "target": 1e3, "rate_per_s": np.inf},
        {"kind": 2, "target": 40e3, "rate_per_s": 1e-15},
        {
            "kind": 4,
            "ticks": 9,
            "amplitude_from": 50e3,
            "frequency_from_hz": 1,
            "frequency_to_hz": 1,
        },
        {"kind": 4, "ticks": 10, "amplitude_to": 60e3, "frequency_to_hz": 1.0, "continues": 1},
        {"kind": 4, "ticks": 10, "amplitude_to": 1e3, "frequency_to_hz": 3e3, "continues": 1},
        {"kind": 4, "ticks": 10, "amplitude_to": np.nan, "frequency_to_hz": 1.0, "continues": 1},
        {"kind": 1, "ticks": -1},
        {"kind": 5, "jump": 5, "times": 2},
        {"kind": 5, "jump": 0, "times": 0},
    ],
)
def test_a_program_that_leads_astray_is_refused_whole(virtual: Virtual, row: Row) -> None:
    good = program([HOLD_ROW | {"ticks": 10}])
    assert virtual.load_program(good) == Reply.ACCEPTED
    active = int(virtual.block.fields["active_program"])
    assert virtual.load_program(program([HOLD_ROW | {"ticks": 10}, row])) == Reply.INVALID_BANK
    assert virtual.block.fields["active_program"] == active
    virtual.bring_to_ready()
    assert virtual.command(Opcode.START, 1) == Reply.ACCEPTED


def test_repeats_that_nest_too_deep_are_refused(virtual: Virtual) -> None:
    def nested(depth: int) -> Any:
        repeat = {"kind": 5, "jump": 0, "times": 2}
        return program([HOLD_ROW | {"ticks": 1}, *[repeat] * depth])

    assert virtual.load_program(nested(9)) == Reply.INVALID_BANK
    assert virtual.load_program(nested(8)) == Reply.ACCEPTED
    virtual.bring_to_ready()
    ticks = len(virtual.run())
    assert ticks == pytest.approx(2**8 + 0.5 / PERIOD_S, abs=3)


def test_a_large_program_is_checked_over_many_ticks(virtual: Virtual) -> None:
    rows = [HOLD_ROW | {"ticks": 1}] * 3000
    before = virtual.tick
    assert virtual.load_program(program(rows)) == Reply.ACCEPTED
    assert virtual.tick - before > 3000 / 40


def test_bad_gains_are_refused(virtual: Virtual) -> None:
    for name, value in (("k_p", np.nan), ("valve_limit", 1.5), ("low_pass_order", 3)):
        wrong = gains()
        wrong[name] = value
        virtual.block.fields["gains"][0] = wrong
        assert virtual.command(Opcode.ADOPT_GAINS, 0) == Reply.INVALID_BANK
    assert virtual.command(Opcode.ADOPT_GAINS, 5) == Reply.INVALID_BANK
    assert virtual.block.fields["active_gains"] == 1


def test_there_is_no_pressure_without_gains_and_interlocks() -> None:
    rig = make()
    rig.command(Opcode.RESET)
    for name in ("has_gains", "has_interlocks"):
        rig.io.core[name] = 0
        assert rig.command(Opcode.PRESSURISE) == Reply.NOT_CONFIGURED
        rig.io.core[name] = 1
    assert rig.command(Opcode.PRESSURISE) == Reply.ACCEPTED


def test_a_rig_does_not_begin_with_gains_that_the_loop_refuses() -> None:
    wrong = gains()
    wrong["k_p"] = np.nan
    with pytest.raises(ValueError, match="gains"):
        Virtual(wrong, interlocks())
    unstable = gains()
    unstable["low_pass_order"] = 2
    unstable["low_pass_rad_s"] = 2.0 * np.pi * 2100.0
    with pytest.raises(ValueError, match="gains"):
        Virtual(unstable, interlocks())


def test_a_program_refilled_while_it_is_checked_is_not_half_checked(virtual: Virtual) -> None:
    """The adoption of a stalled loop is refused by its expiry, and the next begins at the head."""
    virtual.block.fields["programs"][1] = program([HOLD_ROW | {"ticks": 1}] * 3000)
    first = post(virtual.block, Opcode.ADOPT_PROGRAM, 1, now_ns=0)
    virtual.advance(20)
    bad = [{"kind": 2, "target": 1e6, "ticks": 10}, *[HOLD_ROW | {"ticks": 1}] * 700]
    virtual.block.fields["programs"][1] = program(bad)
    virtual.block.fields["commands"][first % 64]["expires_ns"] = 0
    virtual.advance(1)
    assert reply_to(virtual, first) == Reply.EXPIRED
    assert virtual.command(Opcode.ADOPT_PROGRAM, 1) == Reply.INVALID_BANK
    assert virtual.io.core["has_program"] == 0


def test_a_replayed_a_late_and_a_stale_command_are_refused(virtual: Virtual) -> None:
    virtual.command(Opcode.RESET)
    sequence = post(virtual.block, Opcode.PRESSURISE)
    virtual.block.fields["commands"][sequence % 64]["sequence"] = sequence - 1
    virtual.advance(1)
    assert reply_to(virtual, sequence) == Reply.REPLAYED

    late = post(virtual.block, Opcode.PRESSURISE)
    virtual.block.fields["commands"][late % 64]["expires_ns"] = -1
    virtual.advance(1)
    assert reply_to(virtual, late) == Reply.EXPIRED

    post(virtual.block, Opcode.TAKE_LEASE, lease=5)
    stale = post(virtual.block, Opcode.PRESSURISE, lease=4)
    virtual.advance(2)
    assert reply_to(virtual, stale) == Reply.STALE_LEASE
    assert virtual.mode == Mode.OFF


def test_a_stop_needs_neither_lease_nor_haste(running: Virtual) -> None:
    post(running.block, Opcode.TAKE_LEASE, lease=5)
    stop = post(running.block, Opcode.STOP, lease=1)
    running.block.fields["commands"][stop % 64]["expires_ns"] = -1
    running.advance(2)
    assert reply_to(running, stop) == Reply.ACCEPTED
    assert running.mode == Mode.STOPPING


def test_a_new_table_knows_no_rate_of_the_quantity_before() -> None:
    """Pascals a second of the one are not metres a second of the other."""
    slow = {"form": Form.RATE, "smoothing_s": 1.0, "armed_modes": 0x7F}
    rig = make(detector(Quantity.SUPPLY_PRESSURE_PA, 1e12, Action.INDICATE, **slow))
    rig.bring_to_ready()
    rig.command(Opcode.SHUTDOWN)
    rig.advance(400)
    assert abs(rig.io.core["trends"][0]["rate_1_s"]) > 1e6
    rig.block.fields["interlocks"][0] = interlocks(
        detector(Quantity.DISPLACEMENT_M, 1.0, Action.SHUTDOWN, **slow)
    )
    assert rig.command(Opcode.ADOPT_INTERLOCKS, 0) == Reply.ACCEPTED
    rig.advance(4)
    assert abs(rig.block.fields["detector_values"][0]) < 1.0
    assert rig.io.core["trips"] == 0
