"""The gains as the loop has them: given whole or not at all, and compared with those it should have."""

from app.controller.record import to_record
from app.controller.settings import ControllerSettings
from app.errors import Code, Refusal
from app.link.link import Link
from rtcore.codes import Opcode

_RUNNING = Refusal(
    Code.RUN_UNDER_WAY,
    "Cannot change the controller while a test runs: stop it, or wait until it has ended",
)


class LoopGains:
    """The bank of gains of the loop that runs now."""

    def __init__(self, link: Link) -> None:
        self._link = link

    def adopt(self, document: ControllerSettings, lease: int | None = None) -> Refusal | None:
        """Have the loop take gains over; None where it did. Without a lease the console keeps house."""
        refusal = self._link.adopt(Opcode.ADOPT_GAINS, to_record(document), lease)
        if refusal is not None and refusal.code is Code.WRONG_MODE:
            return _RUNNING
        return refusal

    def has(self, document: ControllerSettings) -> bool:
        """Whether a loop runs that works with these gains, to the bit."""
        life = self._link.life
        return life is not None and life.alive and bool(life.gains() == to_record(document))

    def give_later(self) -> None:
        """Have the loop given the gains in force as soon as its supply is off."""
        if self._link.life is not None:
            self._link.life.configured = False
