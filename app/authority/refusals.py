"""Why somebody may not command, and what they can do about it."""

from app.access.principal import Principal
from app.errors import Code, Fault, Refusal

_MINUTE_S, _HOUR_S = 60, 3600
ASK = "ask for it, or take over as an engineer with a reason"


def spoken(who: Principal) -> str:
    """Who that is: "Ann (operator)"."""
    return f"{who.name} ({who.role.name.lower()})"


def lasting(seconds: float) -> str:
    """How long, as one says it: "12 s", "4 min", "2 h"."""
    if seconds < _MINUTE_S:
        return f"{seconds:.0f} s"
    return f"{seconds // _MINUTE_S:.0f} min" if seconds < _HOUR_S else f"{seconds // _HOUR_S:.0f} h"


def nobody() -> Refusal:
    return Refusal(Code.LEASE_NEEDED, "Nobody is in command of the rig: take command first")


def held(by: Principal, since_s: float) -> Refusal:
    return Refusal(Code.LEASE_HELD, f"{_in_command(by, since_s)}: {ASK}")


def not_to_be_taken_over(by: Principal, since_s: float) -> Refusal:
    sentence = f"Only an engineer may take over. {_in_command(by, since_s)}: ask for it"
    return Refusal(Code.NOT_ALLOWED, sentence)


def reason_needed(by: Principal) -> Refusal:
    sentence = f"Say why you take over from {spoken(by)}: they will want to know"
    return Refusal(Code.INVALID_REQUEST, sentence, (Fault("body.reason", "", "a reason"),))


def stale(given: int, present: int) -> Refusal:
    return Refusal(
        Code.STALE_LEASE,
        f"Command has changed hands since (lease {given}, now {present}): look at the rig, "
        "then give the command again",
        about={"current_lease": present},
    )


def nothing_to_ask_for() -> Refusal:
    return Refusal(Code.LEASE_NEEDED, "Nobody is in command of the rig: just take command")


def yours_already() -> Refusal:
    return Refusal(Code.LEASE_HELD, "You are in command already")


def too_many_requests() -> Refusal:
    return Refusal(Code.BUSY, "Too many people ask for command already: try again in a minute")


def unknown_request(request_id: int) -> Refusal:
    sentence = f"There is no request {request_id} any more: it was withdrawn, answered or too old"
    return Refusal(Code.NOT_FOUND, sentence)


def _in_command(by: Principal, since_s: float) -> str:
    return f"{spoken(by)} has been in command for {lasting(since_s)}"
