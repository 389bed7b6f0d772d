"""A loop on the virtual clock that adopts gains and models as the real one does: through its commands and checks."""

from collections.abc import Callable
from typing import Any, Generic, TypeVar

from pydantic import BaseModel

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from rtcore.codes import Opcode, Reply
from rtcore.virtual import PERIOD_S, Virtual

D = TypeVar("D", bound=BaseModel)


class VirtualBank(Generic[D]):
    """One pair of banks of a virtual loop. `dead` is whether it answers nothing."""

    def __init__(self, bank: str, active: str, opcode: Opcode, record: Callable[[D], Any]) -> None:
        gains = gains_record(ControllerSettings())
        self.rig = Virtual(gains, interlocks_record(default_interlocks(), PERIOD_S), twin=True)
        self.dead = False
        self.owed = 0  # how often it was to be given its document later
        self._names = bank, active
        self._opcode, self._record = opcode, record

    def adopt(self, document: D, lease: int | None = None) -> Refusal | None:
        if self.dead:
            return Refusal(Code.LOOP_LOST, "The loop process does not run")
        bank, active = self._names
        fields = self.rig.block.fields
        idle = 1 - int(fields[active])
        fields[bank][idle] = self._record(document)
        reply = self.rig.command(self._opcode, idle, lease=lease)
        return None if reply is Reply.ACCEPTED else Refusal(Code.WRONG_MODE, reply.name.lower())

    def has(self, document: D) -> bool:
        bank, active = self._names
        fields = self.rig.block.fields
        now = fields[bank][int(fields[active])]
        return bool(now.tobytes() == self._record(document).tobytes())

    def give_later(self) -> None:
        self.owed += 1
