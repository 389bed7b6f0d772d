"""`/api/v1/lease`: who is in command."""

from fastapi import APIRouter

from app.access.dependencies import Operator, Viewer
from app.authority.lease import Wish
from app.authority.schemas import (
    HandOver,
    LeaseAsk,
    LeaseBeat,
    LeaseOut,
    LeaseRequestOut,
    LeaseWish,
)
from app.dependencies import AuthorityService
from app.parameters import Number
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/lease", tags=["lease"], responses=PROBLEMS)


@router.get("", operation_id="getLease")
def get_lease(who: Viewer, authority: AuthorityService) -> LeaseOut | None:
    """Who is in command; null where nobody is."""
    return authority.shown()


@router.post("", operation_id="takeLease")
def take_lease(who: Operator, body: LeaseWish, authority: AuthorityService) -> LeaseOut:
    """Take command. Answers once the loop obeys nobody else.

    It lasts `ttl_s` after each sign of its holder: a beat, or any other request.
    """
    wish = Wish(body.reason, body.take_over, body.ttl_s)
    return granted(authority.take(who, wish))


@router.delete("", status_code=204, operation_id="releaseLease")
def release_lease(who: Operator, authority: AuthorityService) -> None:
    """Give command up. A test that runs goes on."""
    granted(authority.release(who))


@router.post("/beat", status_code=204, operation_id="beatLease")
def beat_lease(who: Operator, body: LeaseBeat, authority: AuthorityService) -> None:
    """Stay in command."""
    granted(authority.beat(who, body.epoch))


@router.post("/requests", status_code=201, operation_id="requestLease")
def request_lease(who: Operator, body: LeaseAsk, authority: AuthorityService) -> LeaseRequestOut:
    """Ask whoever is in command for it. Stands for a minute; asking again takes its place."""
    return granted(authority.request(who, body.reason))


@router.delete("/requests/{request_id}", status_code=204, operation_id="declineLeaseRequest")
def decline_lease_request(who: Operator, request_id: Number, authority: AuthorityService) -> None:
    """Decline a request, in command, or withdraw one's own."""
    granted(authority.decline(who, request_id))


@router.post("/hand-over", operation_id="handOverLease")
def hand_over_lease(who: Operator, body: HandOver, authority: AuthorityService) -> LeaseOut:
    """Give command to whoever made a request."""
    return granted(authority.hand_over(who, body.request_id))
