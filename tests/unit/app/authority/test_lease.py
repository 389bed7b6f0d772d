"""Who may have the lease, and for how long: the pure rules."""

import pytest

from app.access.principal import Principal, Role
from app.authority.lease import (
    REQUEST_S,
    TTL_S,
    Lease,
    Wish,
    beyond,
    check,
    decline,
    hand_over,
    passed,
    release,
    renew,
    request,
    take,
)
from app.errors import Code, Refusal

ANN = Principal("session:1", "Ann", Role.OPERATOR, "session")
BOB = Principal("session:2", "Bob", Role.OPERATOR, "session")
EVE = Principal("token:3", "Eve", Role.ENGINEER, "token")


def had(result: Lease | Refusal) -> Lease:
    assert isinstance(result, Lease), result.detail
    return result


def code(result: object) -> Code:
    assert isinstance(result, Refusal)
    return result.code


@pytest.fixture
def anns() -> Lease:
    return had(take(Lease(), ANN, Wish("warm-up"), 100.0))


def test_whoever_comes_first_has_it(anns: Lease) -> None:
    assert anns.is_held_by(ANN.id)
    assert check(anns, ANN, None, 100.0) == anns.epoch == 1
    assert code(take(anns, BOB, Wish(), 101.0)) is Code.LEASE_HELD


def test_a_refusal_names_the_holder_since_when_and_what_to_do(anns: Lease) -> None:
    refusal = check(anns, BOB, None, 100.0 + 250.0)
    assert isinstance(refusal, Refusal)
    assert refusal.detail == (
        "Ann (operator) has been in command for 4 min: "
        "ask for it, or take over as an engineer with a reason"
    )


def test_an_engineer_takes_over_with_a_reason_and_nobody_else_does(anns: Lease) -> None:
    assert code(take(anns, BOB, Wish("mine now", take_over=True), 101.0)) is Code.NOT_ALLOWED
    assert code(take(anns, EVE, Wish("Ann has left"), 101.0)) is Code.LEASE_HELD
    assert code(take(anns, EVE, Wish("  ", take_over=True), 101.0)) is Code.INVALID_REQUEST
    eves = had(take(anns, EVE, Wish("Ann has left", take_over=True), 101.0))
    assert eves.is_held_by(EVE.id)
    assert eves.epoch > anns.epoch
    assert code(check(eves, ANN, anns.epoch, 101.0)) is Code.LEASE_HELD


def test_taking_it_again_makes_the_epoch_of_the_other_window_stale(anns: Lease) -> None:
    again = had(take(anns, ANN, Wish(), 105.0))
    assert again.held is not None
    assert (again.held.since_s, again.held.reason) == (100.0, "warm-up")
    assert code(check(again, ANN, anns.epoch, 105.0)) is Code.STALE_LEASE
    assert check(again, ANN, again.epoch, 105.0) == again.epoch


def test_release_makes_the_epoch_stale_at_once(anns: Lease) -> None:
    assert code(release(anns, BOB.id, 101.0)) is Code.LEASE_HELD
    free = had(release(anns, ANN.id, 101.0))
    assert free.epoch > anns.epoch
    assert code(check(free, ANN, anns.epoch, 101.0)) is Code.LEASE_NEEDED
    assert code(release(free, ANN.id, 102.0)) is Code.LEASE_NEEDED


def test_without_a_sign_it_expires_and_not_before(anns: Lease) -> None:
    kept = renew(anns, ANN.id, 104.0)
    assert passed(kept, 104.0 + TTL_S - 0.001) == kept
    gone = passed(kept, 104.0 + TTL_S)
    assert gone.held is None
    assert gone.epoch == kept.epoch + 1
    assert renew(kept, BOB.id, 105.0) == kept


def test_a_script_may_ask_for_longer() -> None:
    lease = had(take(Lease(), EVE, Wish("overnight", ttl_s=600.0), 0.0))
    assert passed(lease, 599.0) == lease
    assert passed(lease, 600.0).held is None


def test_command_is_handed_to_whoever_asked(anns: Lease) -> None:
    asked = had(request(anns, BOB, "my specimen", 101.0))
    (made,) = asked.requests
    assert code(hand_over(asked, BOB.id, made.id, 102.0)) is Code.LEASE_HELD
    bobs = had(hand_over(asked, ANN.id, made.id, 102.0))
    assert bobs.is_held_by(BOB.id)
    assert bobs.epoch > anns.epoch
    assert bobs.requests == ()
    assert code(hand_over(bobs, BOB.id, made.id, 103.0)) is Code.NOT_FOUND


def test_a_request_is_declined_or_withdrawn_by_nobody_else(anns: Lease) -> None:
    asked = had(request(anns, BOB, "", 101.0))
    (made,) = asked.requests
    assert code(decline(asked, EVE.id, made.id, 102.0)) is Code.LEASE_HELD
    for who in (ANN, BOB):
        after = had(decline(asked, who.id, made.id, 102.0))
        assert after.requests == ()
        assert after.epoch == anns.epoch


def test_requests_stand_for_a_minute_and_once_each(anns: Lease) -> None:
    asked = had(request(had(request(anns, BOB, "first", 101.0)), BOB, "again", 103.0))
    assert [made.reason for made in asked.requests] == ["again"]
    kept = renew(asked, ANN.id, 103.0 + REQUEST_S)
    assert passed(kept, 103.0 + REQUEST_S).requests == ()
    assert passed(kept, 102.0 + REQUEST_S).requests == asked.requests


def test_there_is_nothing_to_ask_for_where_nobody_is_in_command(anns: Lease) -> None:
    assert code(request(Lease(), BOB, "", 0.0)) is Code.LEASE_NEEDED
    assert code(request(anns, ANN, "", 101.0)) is Code.LEASE_HELD


def test_no_more_than_a_handful_can_ask(anns: Lease) -> None:
    lease, refused = anns, []
    for i in range(50):
        asked = request(lease, Principal(f"token:{i}", "x", Role.OPERATOR, "token"), "", 101.0)
        lease = asked if isinstance(asked, Lease) else lease
        refused += [] if isinstance(asked, Lease) else [asked.code]
    assert refused == [Code.BUSY] * (50 - len(lease.requests))
    assert len(lease.requests) == 20


def test_epochs_go_on_from_what_the_loop_obeys(anns: Lease) -> None:
    assert beyond(anns, anns.epoch) == anns
    assert beyond(Lease(), 41).epoch == 42
