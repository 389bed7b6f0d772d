"""Stop on a path of its own: one word of the block, which needs no command, no lease and no room in a ring."""

from time import monotonic_ns

from rtcore.compiled import offset_of, read_index, write_index
from rtcore.memory.layout import BLOCK
from rtcore.memory.segment import Block

_ASKED = offset_of(BLOCK, "stop_asked_ns")


def ask_stop(block: Block) -> None:
    """Have the loop stop in its next tick. From any thread of any process, as often as one likes."""
    before = read_index(block.address + _ASKED)
    write_index(block.address + _ASKED, max(monotonic_ns(), before + 1))
