"""Whom the loop obeys: one epoch, that only grows; and what needs none."""

from hypothesis import given
from hypothesis import strategies as st

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.memory.commands import post
from rtcore.memory.stopping import ask_stop
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.virtual_rigs import make, reply_to

STOPPING = (Opcode.STOP, Opcode.SHUTDOWN)


def test_only_the_epoch_in_force_is_obeyed(virtual: Virtual) -> None:
    assert virtual.command(Opcode.TAKE_LEASE, lease=5) == Reply.ACCEPTED
    assert virtual.block.fields["lease"] == 5
    for other in (0, 4, 6):
        assert virtual.command(Opcode.RESET, lease=other) == Reply.STALE_LEASE
    assert virtual.command(Opcode.RESET, lease=5) == Reply.ACCEPTED
    assert virtual.mode == Mode.OFF


@given(epochs=st.lists(st.integers(-2, 40), min_size=1, max_size=12))
def test_an_epoch_only_grows(epochs: list[int]) -> None:
    rig = _RIG
    for epoch in epochs:
        before = int(rig.block.fields["lease"])
        taken = rig.command(Opcode.TAKE_LEASE, lease=epoch) == Reply.ACCEPTED
        assert taken == (epoch > before)
        assert rig.block.fields["lease"] == max(before, epoch)
        assert rig.command(Opcode.HOLD, lease=before - 1) == Reply.STALE_LEASE


_RIG = make()


def test_what_was_posted_before_command_passed_on_comes_too_late(virtual: Virtual) -> None:
    first = post(virtual.block, Opcode.TAKE_LEASE, lease=2, now_ns=0)
    stale = post(virtual.block, Opcode.RESET, lease=0, now_ns=0)
    virtual.advance(2)
    assert reply_to(virtual, first) == Reply.ACCEPTED
    assert reply_to(virtual, stale) == Reply.STALE_LEASE
    assert virtual.mode == Mode.TRIPPED


def test_command_passes_on_without_moving_anything(running: Virtual) -> None:
    before = running.advance(1)[-1]
    running.command(Opcode.TAKE_LEASE, lease=3)
    after = running.advance(1)[-1]
    assert after["mode"] == before["mode"] == Mode.RUNNING
    assert [int(e["code"]) for e in running.events() if e["kind"] == EventKind.LEASE] == [3]


def test_a_stop_asked_for_in_its_word_needs_no_command(running: Virtual) -> None:
    running.command(Opcode.TAKE_LEASE, lease=3)
    ask_stop(running.block)
    assert running.advance(1)["mode"][-1] == Mode.STOPPING
    assert running.advance(2200)["mode"][-1] == Mode.READY
    told = [e for e in running.events() if e["kind"] == EventKind.STOP_ASKED]
    assert [int(e["code"]) for e in told] == [1]


def test_a_stop_asked_for_twice_in_one_clock_tick_is_seen_each_time(running: Virtual) -> None:
    for _ in range(3):
        before = int(running.block.fields["stop_asked_ns"])
        ask_stop(running.block)
        assert int(running.block.fields["stop_asked_ns"]) > before


def test_a_stop_of_its_own_goes_through_a_full_ring_and_stalled_commands(running: Virtual) -> None:
    for _ in range(64):
        post(running.block, Opcode.HOLD, lease=99, now_ns=0)
    ask_stop(running.block)
    assert running.advance(1)["mode"][-1] == Mode.STOPPING


def test_a_stop_with_nothing_to_stop_changes_nothing(virtual: Virtual) -> None:
    ask_stop(virtual.block)
    assert set(virtual.advance(4)["mode"]) == {Mode.TRIPPED}
    virtual.bring_to_ready()
    ask_stop(virtual.block)
    assert set(virtual.advance(4)["mode"]) == {Mode.READY}


def test_a_stop_while_pressurising_takes_the_pressure_off(virtual: Virtual) -> None:
    virtual.command(Opcode.RESET)
    virtual.command(Opcode.PRESSURISE)
    ask_stop(virtual.block)
    assert virtual.advance(1)["mode"][-1] == Mode.OFF
