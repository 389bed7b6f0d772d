"""Any order of taking, asking, leaving and waiting: one holder at most, and the real loop obeys no other."""

from datetime import UTC, datetime, timedelta
from functools import cache
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from app.access.principal import Principal, Role
from app.authority.lease import Wish
from app.authority.schemas import LeaseOut
from app.authority.service import Authority, Clock
from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from rtcore.codes import Opcode, Reply
from rtcore.virtual import Virtual

PEOPLE = [
    Principal(f"session:{i}", name, role, "session")
    for i, (name, role) in enumerate(
        [("Ann", Role.OPERATOR), ("Bob", Role.OPERATOR), ("Eve", Role.ENGINEER)]
    )
]
people = st.sampled_from(PEOPLE)


@cache
def virtual() -> Virtual:
    """One for all: a rig takes a quarter of a second to make."""
    gains = gains_record(ControllerSettings())
    return Virtual(gains, interlocks_record(default_interlocks(), 250e-6))


class VirtualLoop:
    """The loop's own kernels on a virtual clock; a new life of it obeys epoch 0 again."""

    def __init__(self) -> None:
        self.alive = True
        self.rig = virtual()
        self.begin()

    def begin(self) -> None:
        self.rig.io.core["lease"] = self.rig.block.fields["lease"] = 0

    @property
    def epoch(self) -> int | None:
        return int(self.rig.block.fields["lease"]) if self.alive else None

    def obey(self, epoch: int) -> Refusal | None:
        if not self.alive:
            return Refusal(Code.LOOP_LOST, "lost")
        reply = self.rig.command(Opcode.TAKE_LEASE, lease=epoch)
        return None if reply is Reply.ACCEPTED else Refusal(Code.STALE_LEASE, reply.name)

    def command(self, epoch: int) -> Reply:
        return self.rig.command(Opcode.RESET, lease=epoch)


class Hands(RuleBasedStateMachine):
    """People at one rig; each remembers the epoch that they were given last."""

    def __init__(self) -> None:
        super().__init__()
        self.now_s = 1000.0
        self.loop = VirtualLoop()
        self.told: list[Any] = []
        self.signed_out: set[str] = set()
        self.begin()
        self.given: dict[str, int] = {}
        self.greatest = 0

    def begin(self) -> None:
        began = datetime(2030, 1, 1, tzinfo=UTC) + timedelta(seconds=self.now_s)
        self.authority = Authority(
            self.loop,
            lambda who: who.id not in self.signed_out,
            self.told.append,
            Clock(lambda: self.now_s, began, self.now_s),
        )

    def learn(self, answer: LeaseOut | Refusal) -> None:
        if not isinstance(answer, Refusal):
            assert answer.epoch > self.greatest
            self.greatest = answer.epoch
            self.given[answer.holder_id] = answer.epoch

    @rule(who=people, over=st.booleans(), ttl_s=st.sampled_from([5.0, 10.0, 600.0]))
    def take(self, who: Principal, over: bool, ttl_s: float) -> None:
        before = self.authority.shown()
        answer = self.authority.take(who, Wish("because", over, ttl_s))
        self.learn(answer)
        free = before is None or before.holder_id == who.id
        may = free or (over and who.role >= Role.ENGINEER)
        assert isinstance(answer, LeaseOut) == may

    @rule(who=people)
    def release(self, who: Principal) -> None:
        self.authority.release(who)

    @rule(who=people)
    def sign_out(self, who: Principal) -> None:
        self.signed_out.add(who.id)
        self.authority.look()
        assert isinstance(self.authority.check(who), Refusal)
        self.signed_out.clear()

    @rule(who=people)
    def ask(self, who: Principal) -> None:
        self.authority.request(who, "please")

    @rule(who=people, number=st.integers(1, 6))
    def hand_over(self, who: Principal, number: int) -> None:
        self.learn(self.authority.hand_over(who, number))

    @rule(who=people, number=st.integers(1, 6))
    def decline(self, who: Principal, number: int) -> None:
        self.authority.decline(who, number)

    @rule(who=people)
    def beat(self, who: Principal) -> None:
        self.authority.beat(who, self.given.get(who.id, 0))

    @rule(seconds=st.sampled_from([0.1, 3.0, 9.99, 60.0, 700.0]))
    def wait(self, seconds: float) -> None:
        self.now_s += seconds

    @rule()
    def look(self) -> None:
        self.authority.look()

    @rule()
    def the_app_starts_again(self) -> None:
        self.now_s += 60.0  # more seconds than there were changes
        self.begin()
        self.authority.look()

    @rule()
    def the_loop_dies(self) -> None:
        self.loop.alive = False

    @precondition(lambda self: not self.loop.alive)
    @rule()
    def the_loop_comes_back(self) -> None:
        self.loop.alive = True
        self.loop.begin()
        self.authority.look()

    @precondition(lambda self: self.loop.alive)
    @rule(data=st.data())
    def bypass_the_app(self, data: st.DataObject) -> None:
        """Whatever the app says: the loop obeys the present epoch, which is the holder's or nobody's."""
        self.authority.look()
        known = {0, self.greatest, self.greatest + 1, self.greatest + 2, *self.given.values()}
        epoch = data.draw(st.sampled_from(sorted(known)))
        shown = self.authority.shown()
        obeyed = self.loop.command(epoch) is not Reply.STALE_LEASE
        assert obeyed == (epoch == self.loop.epoch)
        if obeyed and epoch in self.given.values():
            assert shown is not None
            assert self.given[shown.holder_id] == epoch == max(self.given.values())

    @invariant()
    def one_is_in_command_at_most(self) -> None:
        allowed = [who for who in PEOPLE if not isinstance(self.authority.check(who), Refusal)]
        shown = self.authority.shown()
        assert [who.id for who in allowed] == ([] if shown is None else [shown.holder_id])


@pytest.fixture(scope="module", autouse=True)
def compiled() -> None:
    """The kernels, before any example: the first use may compile them."""
    virtual()


TestEveryWay = Hands.TestCase
TestEveryWay.settings = settings(max_examples=60, stateful_step_count=40, deadline=None)
