"""Faults through the loop: given by command, seen in the block, felt by the tick, taken back."""

import numpy as np
import pytest

from rtcore.clock import now_ns
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.memory.rings import event_reader
from rtcore.modes import Mode
from rtcore.rig.faults import FAULTS, Fault
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import gains, interlocks


@pytest.fixture
def rig() -> Virtual:
    rig = Virtual(gains(), interlocks())
    rig.bring_to_ready()
    return rig


def test_a_fault_is_injected_by_command_and_seen_until_it_is_cleared(rig: Virtual) -> None:
    events = event_reader(rig.block)
    assert rig.command(Opcode.INJECT_FAULT, Fault.VALVE_NULL_SHIFT, 1e-5) is Reply.ACCEPTED
    assert rig.block.fields["injected"][Fault.VALVE_NULL_SHIFT] == 1e-5
    rig.advance(1)
    assert rig.io.world["plant"]["null_m"] == 1e-5
    assert rig.command(Opcode.CLEAR_FAULTS) is Reply.ACCEPTED
    assert not np.any(rig.block.fields["injected"])
    rig.advance(1)
    assert rig.io.world["plant"]["null_m"] == 0.0
    told = [e for e in events.read().records if e["kind"] == EventKind.FAULT]
    assert [(e["code"], e["value"]) for e in told] == [(9, 1e-5), (9, 0.0)]


def test_late_ticks_are_told_as_missed_deadlines_on_the_virtual_clock(rig: Virtual) -> None:
    before = int(rig.io.core["deadlines_missed"])
    rig.command(Opcode.INJECT_FAULT, Fault.LATE_TICKS, 0.005)
    rig.advance(3)
    # 5 ms are twenty periods: the tick after is in time for none of the nineteen between.
    assert int(rig.io.core["deadlines_missed"]) - before == 2 * 19


def test_late_ticks_keep_the_processor_on_the_real_clock(rig: Virtual) -> None:
    io, kept_s = rig.io, 0.02
    io.cycle(now_ns(), 0, 0, 0)  # compiles
    rig.command(Opcode.INJECT_FAULT, Fault.LATE_TICKS, kept_s)
    began = now_ns()
    io.cycle(began, 0, 0, 0)
    assert now_ns() - began >= kept_s * 1e9


@pytest.mark.parametrize("fault", Fault, ids=lambda f: f.name)
def test_nothing_becomes_infinite_whatever_breaks_while_the_rig_is_ready(
    rig: Virtual, fault: Fault
) -> None:
    """Half a second after each fault, at either end of what it may be."""
    for amount in (FAULTS[fault].low, FAULTS[fault].high):
        rig.command(Opcode.INJECT_FAULT, fault, amount)
        rig.keep_states = True
        rig.advance(2000)
        assert np.all(np.isfinite(rig.states))
        assert rig.mode in (Mode.READY, Mode.TRIPPED)


@pytest.mark.parametrize(
    ("fault", "asked", "held"),
    [
        (Fault.VALVE_NULL_SHIFT, 1.0, 2e-4),
        (Fault.LOAD_CELL_DRIFT, -1e9, -20e3),
        (Fault.PUMP_LOSS, 1e-300, 1.0),
    ],
)
def test_what_is_told_of_a_fault_is_what_the_rig_has(
    rig: Virtual, fault: Fault, asked: float, held: float
) -> None:
    events = event_reader(rig.block)
    assert rig.command(Opcode.INJECT_FAULT, fault, asked) is Reply.ACCEPTED
    assert rig.block.fields["injected"][fault] == held
    assert [e["value"] for e in events.read().records if e["kind"] == EventKind.FAULT] == [held]
    rig.advance(1)
    assert rig.io.world["failing"]["amounts"][fault] == held


@pytest.mark.parametrize("kind", [-1, 0, len(Fault) + 1, 31, 2**31])
def test_a_fault_that_no_rig_knows_is_refused(rig: Virtual, kind: int) -> None:
    assert rig.command(Opcode.INJECT_FAULT, kind, 1.0) is Reply.UNKNOWN
    assert not np.any(rig.block.fields["injected"])
