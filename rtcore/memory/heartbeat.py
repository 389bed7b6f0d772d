"""The app's heartbeat, kept without the interpreter.

A busy interpreter on a busy machine is late by tenths of a second, and would have the load taken off; one that hangs
shall. So a thread that needs no interpreter beats, as long as the interpreter has shown itself lately.
"""

from time import monotonic_ns
from typing import Any

import numpy as np

from rtcore.clock import now_ns, wait_until
from rtcore.compiled import (
    address_of,
    entry,
    load_acquire,
    offset_of,
    read_index,
    store_release,
    write_index,
)
from rtcore.memory.layout import BLOCK
from rtcore.memory.segment import Block

PERIOD_NS = 20_000_000
PATIENCE_NS = 1_000_000_000  # with an interpreter that does not show itself

_BEATER = np.dtype([("target", "i8"), ("shown_ns", "i8"), ("ended", "i8")])
_TARGET, _SHOWN, _ENDED = (offset_of(_BEATER, name) for name in _BEATER.names or ())
_HEARTBEAT = offset_of(BLOCK, "app_heartbeat_ns")


@entry
def keep_beating(beater: int, period_ns: int, patience_ns: int) -> None:
    """Beat once a period where there is a block to beat in, and while the interpreter shows itself."""
    while load_acquire(beater + _ENDED) == 0:
        now = wait_until(now_ns() + period_ns, 0)
        target = load_acquire(beater + _TARGET)
        if target != 0 and now - load_acquire(beater + _SHOWN) <= patience_ns:
            store_release(target, now)


class Beater:
    """What the beating thread looks at. It keeps the blocks that it may still be writing in."""

    def __init__(self) -> None:
        self._record: Any = np.zeros(1, _BEATER)
        self._address = address_of(self._record)
        self._blocks: list[Block | None] = [None, None]

    def turn_to(self, block: Block | None) -> None:
        """Beat in this block from now on, at once; None: in none."""
        self._blocks = [self._blocks[-1], block]
        self.show()
        if block is not None:
            write_index(block.address + _HEARTBEAT, monotonic_ns())
        write_index(self._address + _TARGET, block.address + _HEARTBEAT if block is not None else 0)

    def show(self) -> None:
        """The interpreter is there."""
        write_index(self._address + _SHOWN, monotonic_ns())

    def keep_beating(self) -> None:
        """Beat until the end; for a thread of its own."""
        keep_beating(self._address, PERIOD_NS, PATIENCE_NS)

    def end(self) -> None:
        """Beat no longer."""
        write_index(self._address + _ENDED, 1)

    def has_ended(self) -> bool:
        """Whether it was told to end."""
        return read_index(self._address + _ENDED) != 0
