"""Who is in command, as the app has it and the loop knows it: nobody gets command before the loop obeys them."""

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from threading import Lock
from typing import Protocol

from app.access.principal import Principal
from app.authority import lease as rules
from app.authority.changes import Change, Word
from app.authority.lease import Lease, Wish
from app.authority.schemas import LeaseOut, LeaseRequestOut
from app.errors import Code, Refusal

_log = logging.getLogger(__name__)
InCommand = Callable[[Principal, int | None], int | Refusal]  # `Authority.check`
_Transition = Callable[[Lease, float], Lease | Refusal]


class Loop(Protocol):
    """What obeys commands of one epoch only."""

    @property
    def epoch(self) -> int | None:
        """The epoch that it obeys; None where no loop runs."""

    def obey(self, epoch: int) -> Refusal | None:
        """Have it obey this epoch and no other; None where it does."""


@dataclass(frozen=True)
class Clock:
    """Seconds that never go back, and the time of day of each."""

    seconds: Callable[[], float] = time.monotonic
    began: datetime = field(default_factory=lambda: datetime.now(UTC))
    began_s: float = field(default_factory=time.monotonic)

    def time_of_day(self, seconds: float) -> datetime:
        """The time of day of a moment, in whole milliseconds."""
        moment = self.began + timedelta(seconds=seconds - self.began_s)
        return moment.replace(microsecond=moment.microsecond // 1000 * 1000)


class Authority:
    """The lease of the rig. May be asked from any thread; only changes of holder wait for the loop.

    `still` says whether somebody may still be here; `tell` is told of every change.
    """

    def __init__(
        self,
        loop: Loop,
        still: Callable[[Principal], bool],
        tell: Callable[[Change], None],
        clock: Clock | None = None,
    ) -> None:
        self._loop = loop
        self._still = still
        self._tell = tell
        self._clock = clock or Clock()
        # Nobody changes hands once a second for long: epochs grow across restarts of everything.
        self._lease = Lease(epoch=int(self._clock.began.timestamp()))
        self._changing = Lock()  # one change after the other, each with the loop's answer
        self._writing = Lock()  # never held for long: beats come from the event loop

    def check(self, who: Principal, epoch: int | None = None) -> int | Refusal:
        """The epoch that a command of theirs bears, or why they may not command.

        Without an epoch it is that of their own lease. A command is a sign of its holder, too.
        """
        with self._writing:
            now_s = self._clock.seconds()
            checked = rules.check(rules.passed(self._lease, now_s), who, epoch, now_s)
            if not isinstance(checked, Refusal):
                self._lease = rules.renew(self._lease, who.id, now_s)
            return checked

    def beat(self, who: Principal, epoch: int) -> Refusal | None:
        """Stay in command; None where they do. Never waits."""
        return _or_none(self.check(who, epoch))

    def seen(self, who: Principal) -> None:
        """Somebody asked for anything at all: if they are in command, they stay so. Never waits."""
        self.check(who)

    def shown(self) -> LeaseOut | None:
        """Who is in command, None where nobody is."""
        now_s = self._clock.seconds()
        lease = rules.passed(self._lease, now_s)
        return None if lease.held is None else LeaseOut.of(lease, now_s, self._clock.time_of_day)

    def take(self, who: Principal, wish: Wish) -> LeaseOut | Refusal:
        """Take command, or over where the wish says so."""
        return self._held(
            self._change(Word.TAKEN, lambda lease, now_s: rules.take(lease, who, wish, now_s))
        )

    def release(self, who: Principal) -> Refusal | None:
        """Give command up; None where that is done."""
        return _or_none(
            self._change(Word.RELEASED, lambda lease, now_s: rules.release(lease, who.id, now_s))
        )

    def request(self, who: Principal, reason: str) -> LeaseRequestOut | Refusal:
        """Ask whoever is in command for it."""
        after = self._change(
            Word.REQUESTED, lambda lease, now_s: rules.request(lease, who, reason, now_s)
        )
        if isinstance(after, Refusal):
            return after
        return LeaseRequestOut.of(after.requests[-1], self._clock.time_of_day)

    def hand_over(self, who: Principal, request_id: int) -> LeaseOut | Refusal:
        """Give command to whoever made this request."""
        return self._held(
            self._change(
                Word.HANDED_OVER,
                lambda lease, now_s: rules.hand_over(lease, who.id, request_id, now_s),
            )
        )

    def decline(self, who: Principal, request_id: int) -> Refusal | None:
        """Say no to a request, or withdraw one's own; None where that is done."""
        return _or_none(
            self._change(
                Word.DECLINED,
                lambda lease, now_s: rules.decline(lease, who.id, request_id, now_s),
            )
        )

    def look(self) -> None:
        """Do what time asks for: let a lease expire, tell a new loop which epoch to obey."""
        with self._changing:
            self._settle()

    def _change(self, word: Word, transition: _Transition) -> Lease | Refusal:
        with self._changing:
            self._settle()
            with self._writing:
                before = self._lease
                after = transition(before, self._clock.seconds())
                if isinstance(after, Refusal):
                    return after
                if after.epoch == before.epoch:
                    self._lease = after
            if after.epoch != before.epoch:
                refusal = self._pass_on(after)
                if refusal is not None:
                    return refusal
            self._announce(word, before, after)
        return after

    def _held(self, after: Lease | Refusal) -> LeaseOut | Refusal:
        if isinstance(after, Refusal):
            return after
        return LeaseOut.of(after, self._clock.seconds(), self._clock.time_of_day)

    def _pass_on(self, after: Lease) -> Refusal | None:
        """Make a change of holder count: with the loop's word for it where somebody is to command."""
        refusal = self._loop.obey(after.epoch)
        lost = refusal is not None and refusal.code is Code.LOOP_LOST  # the next one is told first
        if refusal is not None and not lost and after.held is not None:
            return refusal
        with self._writing:
            self._lease = after
        return None

    def _settle(self) -> None:
        """Do what time and the ends of sessions ask for, one after the other, and tell of it."""
        steps: tuple[tuple[Word, Callable[[Lease], Lease]], ...] = (
            (Word.EXPIRED, lambda lease: rules.passed(lease, self._clock.seconds())),
            (Word.SIGNED_OUT, lambda lease: rules.without_strangers(lease, self._still)),
        )
        for word, settled in steps:
            with self._writing:
                before = self._lease
                self._lease = after = settled(before)
            self._agree()
            if after.epoch != before.epoch:
                self._announce(word, before, after)

    def _agree(self) -> None:
        """Have the loop obey the present epoch, where it is a new one or did not answer before."""
        obeyed = self._loop.epoch
        if obeyed is None or obeyed == self._lease.epoch:
            return
        with self._writing:
            self._lease = rules.beyond(self._lease, obeyed)
        refusal = self._loop.obey(self._lease.epoch)
        if refusal is not None:
            _log.warning("lease %d: %s", self._lease.epoch, refusal.detail)

    def _announce(self, word: Word, before: Lease, after: Lease) -> None:
        if word is Word.TAKEN and before.held is not None:
            if after.is_held_by(before.held.who.id):
                return  # it was theirs already
            word = Word.TAKEN_OVER
        self._tell(Change(word, before, after))


def _or_none(result: object | Refusal) -> Refusal | None:
    return result if isinstance(result, Refusal) else None
