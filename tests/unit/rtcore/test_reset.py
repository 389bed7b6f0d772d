"""Reset: by an edge, with the cause gone, and it starts nothing."""

import numpy as np
import pytest

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.interlocks import Action, Comparison, Quantity
from rtcore.modes import Mode
from rtcore.rig.faults import Fault
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import FORCE_LIMIT, detector
from tests.unit.rtcore.virtual_rigs import LONG, kinds, make

EVERYWHERE = {"armed_modes": 0x7F}
CHAIN = detector(
    Quantity.CHAIN_OPEN, 0.5, Action.SHUTDOWN, comparison=Comparison.ABOVE, **EVERYWHERE
)


def test_a_reset_held_down_clears_nothing_that_trips_meanwhile() -> None:
    rig = make(CHAIN)
    rig.bring_to_ready()
    held = [rig.command(Opcode.RESET)]
    rig.command(Opcode.INJECT_FAULT, Fault.CHAIN_OPEN, 1.0)
    rig.advance(2)
    assert rig.mode == Mode.TRIPPED
    rig.command(Opcode.CLEAR_FAULTS)
    for _ in range(40):  # ten times a second, and longer than the edge takes
        held.append(rig.command(Opcode.RESET))
        rig.advance(400)
    assert set(held[1:]) == {Reply.NOT_AN_EDGE}
    assert set(rig.advance(1000)["mode"]) == {Mode.TRIPPED}
    assert rig.command(Opcode.RESET) == Reply.ACCEPTED
    assert set(rig.advance(1)["mode"]) == {Mode.OFF}


def test_a_fault_that_clears_itself_stays_latched() -> None:
    rig = make(CHAIN)
    rig.bring_to_ready()
    rig.command(Opcode.INJECT_FAULT, Fault.CHAIN_OPEN, 1.0)
    rig.command(Opcode.CLEAR_FAULTS)
    records = rig.advance(8000)
    assert set(records["mode"]) == {Mode.TRIPPED}
    assert set(records["trips"]) == {1}
    assert rig.block.fields["first_out"] == 0


def test_a_reset_starts_nothing() -> None:
    rig = make(CHAIN)
    rig.command(Opcode.RESET)
    records = rig.advance(8000)
    assert set(records["mode"]) == {Mode.OFF}
    assert records["supply_pressure_pa"].max() < 1e6
    assert not records["valve_command"].any()


def test_what_only_indicates_clears_itself_and_keeps_nothing_from_starting() -> None:
    hint = detector(Quantity.FORCE_N, 1500.0, Action.INDICATE, latching=0)
    rig = make(FORCE_LIMIT, hint)
    rig.bring_to_ready()
    rig.load_program(LONG)
    assert rig.command(Opcode.START, 1) == Reply.ACCEPTED
    records = rig.advance(4000)
    assert set(records["trips"]) == {0b00, 0b10}
    beyond = np.abs(records["force_n"]) > 1500.0
    assert np.array_equal(beyond[800:], records["trips"][800:] == 0b10)
    assert rig.block.fields["first_out"] == -1
    trips, cleared = kinds_of(rig)
    assert abs(len(trips) - len(cleared)) <= 1
    assert len(trips) > 50


def kinds_of(rig: Virtual) -> tuple[list[int], list[int]]:
    events = rig.events()
    trips = [int(e["code"]) for e in events if e["kind"] == EventKind.TRIP]
    return trips, [int(e["code"]) for e in events if e["kind"] == EventKind.CLEARED]


@pytest.mark.parametrize("action", [Action.STOP, Action.SHUTDOWN])
def test_what_takes_the_load_off_latches_whatever_its_row_says(action: Action) -> None:
    rig = make(detector(Quantity.FORCE_N, 1500.0, action, latching=0))
    rig.bring_to_ready()
    rig.load_program(LONG)
    rig.command(Opcode.START, 1)
    rig.advance(8000)
    assert rig.mode == Mode.TRIPPED
    assert rig.io.core["trips"] == 1
    assert kinds(rig, EventKind.CLEARED) == []


def test_a_hold_by_a_detector_is_resumed_after_a_reset() -> None:
    rig = make(FORCE_LIMIT, detector(Quantity.FORCE_N, 1500.0, Action.HOLD))
    rig.bring_to_ready()
    rig.load_program(LONG)
    rig.command(Opcode.START, 1)
    rig.advance(4000)
    assert rig.mode == Mode.HOLDING
    assert rig.command(Opcode.RESUME) == Reply.CAUSE_PRESENT
    assert rig.command(Opcode.RESET) == Reply.ACCEPTED
    assert rig.mode == Mode.HOLDING
    assert rig.command(Opcode.RESUME) == Reply.ACCEPTED


def test_nobody_breaks_a_real_rig() -> None:
    rig = make(CHAIN)
    rig.io.core["settings"]["simulated"] = 0
    assert rig.command(Opcode.INJECT_FAULT, Fault.CHAIN_OPEN, 1.0) == Reply.NOT_SIMULATED
    assert not rig.block.fields["injected"].any()


@pytest.mark.parametrize(("kind", "amount"), [(0, 1.0), (32, 1.0), (-1, 1.0), (3, np.nan)])
def test_a_fault_that_is_none_is_refused(kind: int, amount: float) -> None:
    assert make(CHAIN).command(Opcode.INJECT_FAULT, kind, amount) == Reply.UNKNOWN
