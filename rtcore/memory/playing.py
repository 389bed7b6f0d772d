"""How far the program has been played: the generators' states, under a sequence lock as the snapshot.

The app reads from them what a streamed program may overwrite, and what a resume will do.
"""

from typing import Any

import numpy as np

from rtcore.compiled import (
    Record,
    fence,
    kernel,
    load_acquire,
    offset_of,
    read_index,
    store_release,
)
from rtcore.memory.layout import BLOCK
from rtcore.memory.segment import Block
from rtcore.program.generator import GENERATOR, refresh
from rtcore.program.segments import PROGRAM, TABLE

_SEQUENCE = offset_of(BLOCK, "playing_sequence")
_PROGRAMS = offset_of(BLOCK, "programs")
_PROGRAM_BYTES = PROGRAM.itemsize
_FORCE, _MOTION = offset_of(PROGRAM, "force"), offset_of(PROGRAM, "motion")
_COUNT, _KNOT_COUNT = offset_of(TABLE, "count"), offset_of(TABLE, "knot_count")
ATTEMPTS = 1000


@kernel
def see_what_has_come(core: Record, block: Record, block_address: int) -> None:
    """Tell the generators how much of the program is there; nothing of it is read before that."""
    program = block_address + _PROGRAMS + block.active_program * _PROGRAM_BYTES
    force, motion = program + _FORCE, program + _MOTION
    refresh(core.force, load_acquire(force + _COUNT), load_acquire(force + _KNOT_COUNT))
    refresh(core.motion, load_acquire(motion + _COUNT), load_acquire(motion + _KNOT_COUNT))


@kernel
def publish_playing(core: Record, block: Record, block_address: int) -> None:
    """Show both generators as this tick leaves them."""
    sequence = load_acquire(block_address + _SEQUENCE)
    store_release(block_address + _SEQUENCE, sequence + 1)
    fence()
    block.playing_force = core.force
    block.playing_motion = core.motion
    store_release(block_address + _SEQUENCE, sequence + 2)


@kernel
def rewind(core: Record, block: Record, block_address: int) -> None:
    """A program has been adopted: nothing of it has been played."""
    for g in (core.force, core.motion):
        g.segment = 0
        g.knot = 0
    publish_playing(core, block, block_address)


def read_playing(block: Block) -> Any | None:
    """(2,) GENERATOR of force and motion, or None where the writer died in the middle of one."""
    for _ in range(ATTEMPTS):
        before = read_index(block.address + _SEQUENCE)
        states = np.array(
            [block.fields["playing_force"], block.fields["playing_motion"]], GENERATOR
        )
        if before % 2 == 0 and read_index(block.address + _SEQUENCE) == before:
            return states
    return None
