"""The lease as the loop has it: the epoch that it obeys, and how it hears of another."""

from app.errors import Refusal
from app.link.link import Link
from app.link.refusals import as_refusal
from rtcore.codes import Opcode


class LoopLease:
    """What the app tells the present life of the loop about command."""

    def __init__(self, link: Link) -> None:
        self._link = link

    @property
    def epoch(self) -> int | None:
        """The epoch that the loop obeys; None where no loop runs."""
        life = self._link.life
        return life.lease if life is not None and life.alive else None

    def obey(self, epoch: int) -> Refusal | None:
        """Have the loop obey this epoch and no other; None where it does."""
        answer = self._link.commander.ask(Opcode.TAKE_LEASE, lease=epoch)
        return as_refusal(Opcode.TAKE_LEASE, answer)
