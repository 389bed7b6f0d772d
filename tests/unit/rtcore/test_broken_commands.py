"""Commands that are torn, doubled or out of order: the loop does nothing of what was not meant."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.memory.commands import pending, post
from rtcore.memory.layout import COMMAND_SLOTS
from rtcore.modes import Mode
from rtcore.virtual import Virtual
from tests.unit.rtcore.virtual_rigs import kinds, make, reply_to

_RIG = make()
WORDS = st.integers(-(1 << 63), (1 << 63) - 1)


def slots(rig: Virtual) -> npt.NDArray[np.void]:
    commands: npt.NDArray[np.void] = rig.block.fields["commands"]
    return commands


def posted(rig: Virtual) -> int:
    return int(rig.block.fields["commands_posted"])


@given(words=st.lists(WORDS, min_size=1, max_size=6))
def test_a_command_that_is_not_posted_yet_is_not_taken(words: list[int]) -> None:
    """Its writer was killed before the number was raised: whatever it left in the slot."""
    slot = slots(_RIG)[posted(_RIG) % COMMAND_SLOTS : posted(_RIG) % COMMAND_SLOTS + 1]
    slot.view("i8")[: len(words)] = words
    _RIG.events()
    _RIG.advance(3)
    assert not pending(_RIG.block.address)
    assert (len(_RIG.events()), _RIG.mode) == (0, Mode.TRIPPED)


@given(words=st.lists(WORDS, min_size=6, max_size=6))
def test_a_slot_of_anything_at_all_brings_no_pressure(words: list[int]) -> None:
    """As memory that somebody has garbled: it is answered, and the next command is taken."""
    sequence = post(_RIG.block, Opcode.HOLD, now_ns=0)
    slots(_RIG)[sequence % COMMAND_SLOTS : sequence % COMMAND_SLOTS + 1].view("i8")[:] = words
    _RIG.advance(1)
    assert words[0] == sequence or reply_to(_RIG, sequence) == Reply.REPLAYED
    assert not pending(_RIG.block.address)
    assert _RIG.mode == Mode.TRIPPED
    after = post(_RIG.block, Opcode.PRESSURISE, lease=int(_RIG.block.fields["lease"]), now_ns=0)
    _RIG.advance(1)
    assert reply_to(_RIG, after) == Reply.WRONG_MODE


def test_a_command_that_is_torn_is_not_obeyed(virtual: Virtual) -> None:
    """The number of the one before is in the slot still: the rest is of the new one."""
    virtual.command(Opcode.RESET)
    sequence = post(virtual.block, Opcode.PRESSURISE, now_ns=0)
    slots(virtual)[sequence % COMMAND_SLOTS]["sequence"] = sequence - COMMAND_SLOTS
    virtual.advance(1)
    assert reply_to(virtual, sequence) == Reply.REPLAYED
    assert virtual.mode == Mode.OFF


def test_a_doubled_command_is_obeyed_once(running: Virtual) -> None:
    first = post(running.block, Opcode.HOLD, now_ns=int(1e18))
    second = post(running.block, Opcode.HOLD, now_ns=int(1e18))
    copied = slots(running)[first % COMMAND_SLOTS]
    slots(running)[second % COMMAND_SLOTS] = copied
    running.advance(2)
    assert (reply_to(running, first), reply_to(running, second)) == (Reply.ACCEPTED, Reply.REPLAYED)
    assert kinds(running, EventKind.MODE).count(Mode.HOLDING) == 1


@pytest.mark.parametrize("order", [(1, 0), (1, 2, 0), (2, 1, 0)])
def test_commands_out_of_order_are_refused_and_the_next_is_taken(
    virtual: Virtual, order: tuple[int, ...]
) -> None:
    far = int(1e18)
    asked = [Opcode.RESET, Opcode.PRESSURISE, Opcode.DEPRESSURISE][: len(order)]
    numbers = [post(virtual.block, opcode, now_ns=far) for opcode in asked]
    at = [number % COMMAND_SLOTS for number in numbers]
    slots(virtual)[at] = slots(virtual)[at][list(order)]
    virtual.advance(len(order))
    moved = [
        number for number, place in zip(numbers, order, strict=True) if numbers[place] != number
    ]
    assert {reply_to(virtual, number) for number in moved} == {Reply.REPLAYED}
    assert virtual.mode == Mode.TRIPPED
    assert virtual.command(Opcode.RESET) == Reply.ACCEPTED
