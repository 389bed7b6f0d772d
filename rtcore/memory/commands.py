"""The ring of commands from the app to the loop, and the ring of acknowledgements back."""

from time import monotonic_ns

from rtcore.codes import Opcode
from rtcore.compiled import (
    carray,
    kernel,
    load_acquire,
    offset_of,
    pointer,
    read_index,
    store_release,
    write_index,
)
from rtcore.memory.layout import BLOCK, COMMAND_SLOTS
from rtcore.memory.segment import Block

_POSTED = offset_of(BLOCK, "commands_posted")
_TAKEN = offset_of(BLOCK, "commands_taken")


class CommandsFull(Exception):
    """The loop has not taken the last commands: it is stopped or gone."""


def post(
    block: Block,
    opcode: Opcode,
    argument: int = 0,
    *,
    lease: int = 0,
    value: float = 0.0,
    time_to_live_s: float = 0.5,
    now_ns: int | None = None,
) -> int:
    """Post a command and return its sequence number. One thread of one process may post.

    Raises `CommandsFull` where the ring is full.
    """
    sequence = read_index(block.address + _POSTED)
    if sequence - read_index(block.address + _TAKEN) >= COMMAND_SLOTS:
        raise CommandsFull("the loop process takes no commands: it is stopped or gone")
    slot = block.fields["commands"][sequence % COMMAND_SLOTS]
    slot["sequence"] = sequence
    slot["opcode"] = opcode
    slot["argument"] = argument
    slot["lease"] = lease
    slot["value"] = value
    slot["expires_ns"] = (monotonic_ns() if now_ns is None else now_ns) + int(time_to_live_s * 1e9)
    write_index(block.address + _POSTED, sequence + 1)
    return sequence


def acknowledgement(block: Block, sequence: int) -> tuple[int, int] | None:
    """(reply, tick) to a command, or None while the loop has not answered."""
    if read_index(block.address + _TAKEN) <= sequence:
        return None
    slot = block.fields["acknowledgements"][sequence % COMMAND_SLOTS]
    if slot["sequence"] != sequence:
        return None
    return int(slot["reply"]), int(slot["tick"])


@kernel
def pending(block_address: int) -> bool:
    """Whether a command waits to be taken."""
    return load_acquire(block_address + _POSTED) > load_acquire(block_address + _TAKEN)


@kernel
def acknowledge(block_address: int, reply: int, tick: int) -> None:
    """Answer the command at the head of the ring and take it off."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    taken = load_acquire(block_address + _TAKEN)
    slot = block.acknowledgements[taken % COMMAND_SLOTS]
    slot.sequence = taken
    slot.tick = tick
    slot.reply = reply
    store_release(block_address + _TAKEN, taken + 1)
