"""What everybody is told when command changes hands, or is asked for."""

from dataclasses import dataclass
from enum import StrEnum

from app.audit.record import Entry
from app.authority.lease import Held, Lease, Request
from app.authority.refusals import lasting, spoken


class Word(StrEnum):
    """What became of the lease."""

    TAKEN = "taken"
    TAKEN_OVER = "taken_over"
    RELEASED = "released"
    HANDED_OVER = "handed_over"
    EXPIRED = "expired"
    SIGNED_OUT = "signed_out"
    REQUESTED = "requested"
    DECLINED = "declined"


@dataclass(frozen=True)
class Change:
    """A change of the lease, from what it was to what it is."""

    word: Word
    before: Lease
    after: Lease

    @property
    def text(self) -> str:
        """What happened, for everybody at the rig."""
        return _SENTENCES[self.word].format(
            who=_holder(self.after.held),
            before=_holder(self.before.held),
            reason=_because(self.after.held),
            ttl=lasting(self.before.held.ttl_s) if self.before.held else "",
            asks=_asks(self._requests(self.after, self.before)),
            asked=_asked(self._requests(self.before, self.after)),
        )

    def entry(self) -> Entry:
        """For the audit."""
        held = self.after.held
        reason = held.reason if held is not None and self.word in _GRANTS else None
        return Entry(
            *(f"lease.{self.word}", "rig"),
            why=reason or None,
            before=_shown(self.before),
            after=_shown(self.after),
        )

    @staticmethod
    def _requests(there: Lease, not_there: Lease) -> Request | None:
        """The request that one has and the other has not."""
        return next((r for r in reversed(there.requests) if r not in not_there.requests), None)


_GRANTS = (Word.TAKEN, Word.TAKEN_OVER, Word.HANDED_OVER)
_SENTENCES = {
    Word.TAKEN: "{who} is in command{reason}",
    Word.TAKEN_OVER: "{who} has taken over from {before}{reason}",
    Word.RELEASED: "{before} is no longer in command",
    Word.HANDED_OVER: "{before} has handed command over to {who}",
    Word.EXPIRED: "{before} is no longer in command: no sign of them for {ttl}",
    Word.SIGNED_OUT: "{before} is no longer in command: signed out",
    Word.REQUESTED: "{asks}",
    Word.DECLINED: "{asked} does not get command now",
}


def _holder(held: Held | None) -> str:
    return "nobody" if held is None else spoken(held.who)


def _because(held: Held | None) -> str:
    return f": {held.reason}" if held is not None and held.reason else ""


def _asks(made: Request | None) -> str:
    if made is None:
        return "Command is asked for"
    return f"{spoken(made.who)} asks for command" + (f": {made.reason}" if made.reason else "")


def _asked(gone: Request | None) -> str:
    return "Nobody" if gone is None else spoken(gone.who)


def _shown(lease: Lease) -> dict[str, object]:
    return {
        "epoch": lease.epoch,
        "holder": None if lease.held is None else spoken(lease.held.who),
        "requests": [spoken(made.who) for made in lease.requests],
    }
