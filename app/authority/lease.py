"""The lease of a rig as a pure state machine: each function takes the clock and returns what is so then.

Whoever holds it is in command. Every change of holder has an epoch of its own, greater than all before it;
so has the end of command without a successor, which makes what the holder still sends stale at once.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from app.access.principal import Principal, Role
from app.authority import refusals
from app.errors import Refusal

TTL_S = 10.0
SHORTEST_TTL_S, LONGEST_TTL_S = 5.0, 600.0
REQUEST_S = 60.0  # how long a request for command stands
MOST_REQUESTS = 20


@dataclass(frozen=True)
class Held:
    """Somebody in command. Without a sign of theirs for `ttl_s` they are no longer."""

    who: Principal
    since_s: float
    reason: str
    ttl_s: float
    seen_s: float

    def left_s(self, now_s: float) -> float:
        """For how long they stay in command without another sign of them; never less than 0."""
        return max(0.0, self.seen_s + self.ttl_s - now_s)


@dataclass(frozen=True)
class Request:
    """Somebody who would like to be in command."""

    id: int
    who: Principal
    reason: str
    since_s: float


@dataclass(frozen=True)
class Lease:
    """The lease and who asks for it, the oldest request first. `asked` counts requests for their ids."""

    epoch: int = 0
    held: Held | None = None
    requests: tuple[Request, ...] = ()
    asked: int = 0

    def is_held_by(self, who_id: str) -> bool:
        """Whether this principal is in command."""
        return self.held is not None and self.held.who.id == who_id


@dataclass(frozen=True)
class Wish:
    """How somebody wants the lease."""

    reason: str = ""
    take_over: bool = False
    ttl_s: float = TTL_S


def passed(lease: Lease, now_s: float) -> Lease:
    """What time has done: a holder that gave no sign is out, requests nobody answered are gone."""
    standing = _without(lease, lambda request: now_s - request.since_s >= REQUEST_S)
    if lease.held is not None and lease.held.left_s(now_s) == 0.0:
        return _freed(standing)
    return standing


def take(lease: Lease, who: Principal, wish: Wish, now_s: float) -> Lease | Refusal:
    """Take command where nobody has it, or over from somebody.

    Who has it already gets it anew: two windows of one session are not both in command.
    """
    held = lease.held
    if held is None:
        return _given(lease, who, wish, now_s)
    if held.who.id == who.id:
        again = replace(held, reason=wish.reason or held.reason, ttl_s=wish.ttl_s, seen_s=now_s)
        return replace(lease, epoch=lease.epoch + 1, held=again)
    return _why_not_over(held, who, wish, now_s) or _given(lease, who, wish, now_s)


def _why_not_over(held: Held, who: Principal, wish: Wish, now_s: float) -> Refusal | None:
    if not wish.take_over:
        return refusals.held(held.who, now_s - held.since_s)
    if who.role < Role.ENGINEER:
        return refusals.not_to_be_taken_over(held.who, now_s - held.since_s)
    return None if wish.reason.strip() else refusals.reason_needed(held.who)


def release(lease: Lease, who_id: str, now_s: float) -> Lease | Refusal:
    """Give command up."""
    return _freed(lease) if lease.is_held_by(who_id) else _not_in_command(lease, now_s)


def renew(lease: Lease, who_id: str, now_s: float) -> Lease:
    """A sign of somebody: their command goes on, where they have it."""
    if lease.held is None or lease.held.who.id != who_id:
        return lease
    return replace(lease, held=replace(lease.held, seen_s=now_s))


def request(lease: Lease, who: Principal, reason: str, now_s: float) -> Lease | Refusal:
    """Ask whoever is in command for it. Asking again stands for what was asked before."""
    if lease.held is None:
        return refusals.nothing_to_ask_for()
    if lease.held.who.id == who.id:
        return refusals.yours_already()
    others = _without(lease, lambda request: request.who.id == who.id)
    if len(others.requests) >= MOST_REQUESTS:
        return refusals.too_many_requests()
    made = Request(lease.asked + 1, who, reason, now_s)
    return replace(others, requests=(*others.requests, made), asked=made.id)


def hand_over(lease: Lease, who_id: str, request_id: int, now_s: float) -> Lease | Refusal:
    """Give command to somebody who asked for it."""
    if not lease.is_held_by(who_id):
        return _not_in_command(lease, now_s)
    wanted = _find(lease, request_id)
    if wanted is None:
        return refusals.unknown_request(request_id)
    return _given(lease, wanted.who, Wish(wanted.reason), now_s)


def decline(lease: Lease, who_id: str, request_id: int, now_s: float) -> Lease | Refusal:
    """Take a request away: whoever is in command says no, or who made it thinks better of it."""
    unwanted = _find(lease, request_id)
    if unwanted is None:
        return refusals.unknown_request(request_id)
    if not lease.is_held_by(who_id) and unwanted.who.id != who_id:
        return _not_in_command(lease, now_s)
    return _without(lease, lambda request: request.id == request_id)


def check(lease: Lease, who: Principal, epoch: int | None, now_s: float) -> int | Refusal:
    """The epoch that a command of theirs bears, where they are in command."""
    if not lease.is_held_by(who.id):
        return _not_in_command(lease, now_s)
    if epoch is not None and epoch != lease.epoch:
        return refusals.stale(epoch, lease.epoch)
    return lease.epoch


def without_strangers(lease: Lease, still: Callable[[Principal], bool]) -> Lease:
    """What is left where a session or token has ended: neither their command nor their requests."""
    known = _without(lease, lambda request: not still(request.who))
    gone = lease.held is not None and not still(lease.held.who)
    return _freed(known) if gone else known


def beyond(lease: Lease, epoch: int) -> Lease:
    """The same with an epoch of its own, where the loop obeys a later one than was known here."""
    return lease if epoch <= lease.epoch else replace(lease, epoch=epoch + 1)


def _given(lease: Lease, who: Principal, wish: Wish, now_s: float) -> Lease:
    held = Held(who, now_s, wish.reason, wish.ttl_s, now_s)
    others = _without(lease, lambda request: request.who.id == who.id)
    return replace(others, epoch=lease.epoch + 1, held=held)


def _freed(lease: Lease) -> Lease:
    return replace(lease, epoch=lease.epoch + 1, held=None)


def _find(lease: Lease, request_id: int) -> Request | None:
    return next((request for request in lease.requests if request.id == request_id), None)


def _without(lease: Lease, gone: Callable[[Request], bool]) -> Lease:
    kept = tuple(request for request in lease.requests if not gone(request))
    return lease if kept == lease.requests else replace(lease, requests=kept)


def _not_in_command(lease: Lease, now_s: float) -> Refusal:
    if lease.held is None:
        return refusals.nobody()
    return refusals.held(lease.held.who, now_s - lease.held.since_s)
