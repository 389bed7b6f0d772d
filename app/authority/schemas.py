"""What the requests about command take and give; the lease is in the status, too."""

from collections.abc import Callable
from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from app.authority.lease import LONGEST_TTL_S, SHORTEST_TTL_S, TTL_S, Lease, Request
from app.db import NO_NUL

MOST_EPOCHS = 2**53

Reason = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=200)]
Epoch = Annotated[int, Field(ge=0, le=MOST_EPOCHS)]


class LeaseWish(BaseModel):
    """Take command. Over from somebody only as an engineer, and with a reason."""

    model_config = ConfigDict(extra="forbid")

    reason: Reason = ""
    take_over: bool = False
    ttl_s: Annotated[float, Field(ge=SHORTEST_TTL_S, le=LONGEST_TTL_S)] = TTL_S


class LeaseBeat(BaseModel):
    """A sign of whoever is in command."""

    model_config = ConfigDict(extra="forbid")

    epoch: Epoch


class LeaseAsk(BaseModel):
    """Ask whoever is in command for it."""

    model_config = ConfigDict(extra="forbid")

    reason: Reason = ""


class HandOver(BaseModel):
    """Give command to whoever made this request."""

    model_config = ConfigDict(extra="forbid")

    request_id: Annotated[int, Field(ge=1, le=2**53)]


TimeOfDay = Callable[[float], datetime]


class LeaseRequestOut(BaseModel):
    """Somebody who asks for command, until it is answered or a minute has passed."""

    id: int
    name: str
    requester_id: str
    reason: str
    since: datetime

    @staticmethod
    def of(made: Request, time_of_day: TimeOfDay) -> "LeaseRequestOut":
        return LeaseRequestOut(
            id=made.id,
            name=made.who.name,
            requester_id=made.who.id,
            reason=made.reason,
            since=time_of_day(made.since_s),
        )


class LeaseOut(BaseModel):
    """Who is in command. Every command bears the `epoch`, which each change of holder renews."""

    epoch: int
    holder: str
    holder_id: str
    role: str
    since: datetime
    reason: str
    expires_in_s: float
    requests: list[LeaseRequestOut]

    @staticmethod
    def of(lease: Lease, now_s: float, time_of_day: TimeOfDay) -> "LeaseOut":
        """A lease that somebody holds."""
        held = lease.held
        assert held is not None
        return LeaseOut(
            epoch=lease.epoch,
            holder=held.who.name,
            holder_id=held.who.id,
            role=held.who.role.name.lower(),
            since=time_of_day(held.since_s),
            reason=held.reason,
            expires_in_s=round(held.left_s(now_s), 1),
            requests=[LeaseRequestOut.of(made, time_of_day) for made in lease.requests],
        )
