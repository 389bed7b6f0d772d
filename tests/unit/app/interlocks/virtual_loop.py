"""A loop on the virtual clock that adopts tables as the real one does: through its command and its checks."""

from time import monotonic_ns
from types import SimpleNamespace
from typing import cast

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.expansion import expand
from app.definitions.library import library
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.live import LiveTable
from app.interlocks.loop_table import is_of
from app.interlocks.record import to_record
from app.interlocks.table import Interlocks
from app.link.life import Life
from app.link.link import Link
from rtcore.codes import Opcode, Reply
from rtcore.virtual import PERIOD_S, Virtual


class VirtualLoop:
    """A loop with the shipped table. `dead` is whether it answers nothing."""

    def __init__(self) -> None:
        gains = gains_record(ControllerSettings())
        self.rig = Virtual(gains, to_record(default_interlocks(), PERIOD_S))
        self.dead = False
        self.owed = 0  # how often it was to be given its table later
        self._life = Life(self.rig.block)

    def adopt(self, interlocks: Interlocks, lease: int | None = None) -> Refusal | None:
        if self.dead:
            return Refusal(Code.LOOP_LOST, "The loop process does not run")
        fields = self.rig.block.fields
        idle = 1 - int(fields["active_interlocks"])
        fields["interlocks"][idle] = to_record(interlocks, PERIOD_S)
        reply = self.rig.command(Opcode.ADOPT_INTERLOCKS, idle, lease=lease)
        return None if reply is Reply.ACCEPTED else Refusal(Code.WRONG_MODE, reply.name.lower())

    def has(self, interlocks: Interlocks) -> bool:
        return is_of(self._life, interlocks)

    def give_later(self) -> None:
        self.owed += 1

    def start_a_run(self) -> None:
        """Bring the rig to run the step of 2 kN."""
        self.rig.bring_to_ready()
        assert self.rig.load_program(expand(library()["step-2-kn"])) == Reply.ACCEPTED
        assert self.rig.command(Opcode.START, 1) == Reply.ACCEPTED

    def live(self, interlocks: Interlocks) -> LiveTable:
        """What reads its detectors."""
        return LiveTable(cast(Link, SimpleNamespace(life=self._life)), interlocks)

    def beat(self) -> None:
        """Look alive: virtual ticks leave no sign of life at the time of day."""
        self.rig.block.fields["loop_heartbeat_ns"] = monotonic_ns()
