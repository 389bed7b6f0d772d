"""The table as the loop has it: given whole or not at all, and compared with the one it should have."""

from typing import Any

import numpy as np

from app.definitions.limits import RIG
from app.errors import Code, Refusal
from app.interlocks.record import to_record
from app.interlocks.table import Interlocks
from app.link.life import Life
from app.link.link import Link
from rtcore.codes import Opcode

_RUNNING = Refusal(
    Code.RUN_UNDER_WAY,
    "Cannot change the interlocks while a test runs: stop it, or wait until it has ended",
)


class LoopTable:
    """The bank of detectors of the loop that runs now."""

    def __init__(self, link: Link) -> None:
        self._link = link

    def adopt(self, interlocks: Interlocks, lease: int | None = None) -> Refusal | None:
        """Have the loop take a table over; None where it did. Without a lease the console keeps house."""
        record = to_record(interlocks, RIG.period_s)
        refusal = self._link.adopt(Opcode.ADOPT_INTERLOCKS, record, lease)
        if refusal is not None and refusal.code is Code.WRONG_MODE:
            return _RUNNING
        return refusal

    def has(self, interlocks: Interlocks) -> bool:
        """Whether a loop runs that watches with this table."""
        life = self._link.life
        return life is not None and life.alive and is_of(life, interlocks)

    def give_later(self) -> None:
        """Have the loop given the table in force as soon as its supply is off."""
        if self._link.life is not None:
            self._link.life.configured = False


def is_of(life: Life, interlocks: Interlocks) -> bool:
    """Whether the loop's table is this one, to the bit."""
    record: Any = to_record(interlocks, RIG.period_s)
    wanted = record["detectors"][: int(record["count"])]
    found = life.detectors()
    return len(found) == len(wanted) and bool(np.all(found == wanted))
