"""The lease between people and the loop: what counts when, and what everybody is told."""

from dataclasses import dataclass, field
from datetime import UTC, datetime

import pytest

from app.access.principal import Principal, Role
from app.authority.changes import Change
from app.authority.lease import Wish
from app.authority.schemas import LeaseOut, LeaseRequestOut
from app.authority.service import Authority, Clock
from app.errors import Code, Refusal

ANN = Principal("session:1", "Ann", Role.OPERATOR, "session")
BOB = Principal("session:2", "Bob", Role.OPERATOR, "session")
EVE = Principal("session:3", "Eve", Role.ENGINEER, "session")
SILENT = Refusal(Code.LOOP_SILENT, "The loop does not answer")
LOST = Refusal(Code.LOOP_LOST, "There is no loop")


@dataclass
class Lab:
    """An authority with a loop, a clock and a door that do as a test says."""

    now_s: float = 0.0
    epoch: int | None = 0  # what the loop obeys
    fails: Refusal | None = None
    gone: set[str] = field(default_factory=set)
    told: list[Change] = field(default_factory=list)

    def __post_init__(self) -> None:
        clock = Clock(lambda: self.now_s, datetime.fromtimestamp(1000.0, UTC), 0.0)
        self.authority = Authority(self, lambda who: who.id not in self.gone, self.tell, clock)
        self.authority.look()

    def tell(self, change: Change) -> None:
        self.told.append(change)

    def obey(self, epoch: int) -> Refusal | None:
        if self.fails is not None:
            return self.fails
        assert self.epoch is not None
        assert epoch > self.epoch
        self.epoch = epoch
        return None

    def take(self, who: Principal, wish: Wish | None = None) -> LeaseOut:
        taken = self.authority.take(who, wish or Wish("because"))
        assert isinstance(taken, LeaseOut), taken.detail
        return taken

    def words(self) -> list[str]:
        return [change.text for change in self.told]


@pytest.fixture
def lab() -> Lab:
    return Lab()


def code(answer: object) -> Code:
    assert isinstance(answer, Refusal)
    return answer.code


def test_the_loop_hears_of_it_before_it_counts(lab: Lab) -> None:
    taken = lab.take(ANN)
    assert lab.epoch == taken.epoch == lab.authority.check(ANN) == 1001
    lab.authority.release(ANN)
    assert lab.epoch == 1002


def test_a_loop_that_does_not_answer_gives_nobody_command(lab: Lab) -> None:
    lab.fails = SILENT
    assert lab.authority.take(ANN, Wish()) == SILENT
    assert lab.authority.shown() is None
    assert lab.told == []


def test_what_was_taken_away_stays_so_and_the_loop_hears_of_it_later(lab: Lab) -> None:
    lab.take(ANN)
    lab.fails = SILENT
    assert lab.authority.release(ANN) is None
    assert code(lab.authority.check(ANN)) is Code.LEASE_NEEDED
    assert lab.epoch == 1001
    lab.fails = None
    lab.authority.look()
    assert lab.epoch == 1002


def test_without_a_loop_command_is_taken_and_the_next_loop_hears_of_it(lab: Lab) -> None:
    lab.epoch, lab.fails = None, LOST
    taken = lab.take(ANN)
    lab.epoch, lab.fails = 0, None
    lab.authority.look()
    assert lab.epoch == taken.epoch


def test_epochs_go_on_from_a_loop_that_is_ahead(lab: Lab) -> None:
    lab.epoch = 5000
    assert lab.take(ANN).epoch == lab.epoch == 5002


def test_any_request_of_the_holder_keeps_it_and_of_nobody_else(lab: Lab) -> None:
    lab.take(ANN)
    for _ in range(5):
        lab.now_s += 9.0
        lab.authority.seen(ANN)
        lab.authority.look()
    for _ in range(2):
        lab.now_s += 9.0
        lab.authority.seen(BOB)
    assert lab.authority.shown() is None
    lab.authority.seen(ANN)  # too late
    assert code(lab.authority.check(ANN)) is Code.LEASE_NEEDED
    lab.authority.look()
    assert lab.words()[-1] == "Ann (operator) is no longer in command: no sign of them for 10 s"


def test_it_ends_with_the_session(lab: Lab) -> None:
    epoch = lab.take(ANN).epoch
    lab.authority.request(BOB, "")
    lab.gone = {ANN.id, BOB.id}
    lab.authority.look()
    assert lab.epoch == epoch + 1
    assert code(lab.authority.check(ANN, epoch)) is Code.LEASE_NEEDED
    assert lab.words()[-1] == "Ann (operator) is no longer in command: signed out"


def test_everybody_is_told_in_words(lab: Lab) -> None:
    lab.take(ANN, Wish("Warm-up"))
    lab.take(ANN)  # again: nothing new
    asked = lab.authority.request(BOB, "My specimen")
    assert isinstance(asked, LeaseRequestOut)
    lab.authority.decline(ANN, asked.id)
    asked = lab.authority.request(BOB, "")
    assert isinstance(asked, LeaseRequestOut)
    lab.authority.hand_over(ANN, asked.id)
    lab.take(EVE, Wish("Bob has left", take_over=True))
    lab.authority.release(EVE)
    assert lab.words() == [
        "Ann (operator) is in command: Warm-up",
        "Bob (operator) asks for command: My specimen",
        "Bob (operator) does not get command now",
        "Bob (operator) asks for command",
        "Ann (operator) has handed command over to Bob (operator)",
        "Eve (engineer) has taken over from Bob (operator): Bob has left",
        "Eve (engineer) is no longer in command",
    ]


def test_it_is_shown_with_the_time_of_day(lab: Lab) -> None:
    lab.take(ANN, Wish(ttl_s=60.0))
    lab.now_s = 12.5
    shown = lab.authority.shown()
    assert shown is not None
    assert shown.since == datetime.fromtimestamp(1000.0, UTC)
    assert shown.expires_in_s == 47.5
