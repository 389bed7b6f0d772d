"""Commands: answered, refused, or given up on; and none waits for another one's answer."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from threading import Event, Thread
from time import monotonic_ns

import pytest

from app.errors import Code, Refusal
from app.link.banks import adopt
from app.link.commander import Answer, Commander
from app.link.refusals import as_refusal
from rtcore.codes import Opcode, Reply
from rtcore.memory.commands import acknowledge, pending
from rtcore.memory.layout import COMMAND_SLOTS
from tests.written_block import WrittenBlock


class Obedient:
    """A loop that only answers commands, with the reply that it is told to give."""

    def __init__(self) -> None:
        self.written = WrittenBlock()
        self.reply = Reply.ACCEPTED
        self.seen: list[tuple[int, int]] = []
        self.deaf_to: set[Opcode] = set()
        self._ended = Event()
        self._thread = Thread(target=self._run)

    def __enter__(self) -> "Obedient":
        self.beat()
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()

    def beat(self, age_s: float = 0.0) -> None:
        block = self.written.block
        block.fields["loop_heartbeat_ns"] = monotonic_ns() - int(age_s * 1e9)

    def _run(self) -> None:
        block = self.written.block
        while not self._ended.wait(0.001):
            self.beat()
            while pending(block.address) and not self._ended.is_set():
                command = block.fields["commands"][
                    int(block.fields["commands_taken"]) % COMMAND_SLOTS
                ]
                if Opcode(int(command["opcode"])) in self.deaf_to:
                    self._ended.wait(0.001)
                    continue
                self.seen.append((int(command["opcode"]), int(command["argument"])))
                acknowledge(block.address, int(self.reply), 1234)


@pytest.fixture
def loop() -> Iterator[Obedient]:
    with Obedient() as obedient:
        yield obedient


@pytest.fixture
def commander(loop: Obedient) -> Commander:
    commander = Commander()
    commander.turn_to(loop.written.life())
    return commander


def test_an_answer_has_the_reply_and_the_tick(loop: Obedient, commander: Commander) -> None:
    assert commander.ask(Opcode.START, 17) == Answer(Reply.ACCEPTED, 1234)
    assert loop.seen == [(Opcode.START, 17)]


@pytest.mark.parametrize("reply", [reply for reply in Reply if reply is not Reply.ACCEPTED])
def test_every_other_reply_is_a_refusal_with_a_sentence(
    loop: Obedient, commander: Commander, reply: Reply
) -> None:
    loop.reply = reply
    refusal = as_refusal(Opcode.START, commander.ask(Opcode.START))
    assert refusal is not None
    assert refusal.detail.startswith("Cannot start: ")


def test_many_at_once_are_each_answered(loop: Obedient, commander: Commander) -> None:
    interval_s = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as threads:
            answers = list(threads.map(lambda i: commander.ask(Opcode.HOLD, i), range(200)))
    finally:
        sys.setswitchinterval(interval_s)
    assert answers == [Answer(Reply.ACCEPTED, 1234)] * 200
    assert sorted(argument for _, argument in loop.seen) == list(range(200))


def test_without_an_answer_the_command_is_given_up(loop: Obedient, commander: Commander) -> None:
    loop.deaf_to = {Opcode.START}
    answer = commander.ask(Opcode.START)
    assert isinstance(answer, Refusal)
    assert answer.code is Code.LOOP_SILENT


def test_a_full_ring_is_a_refusal_too(loop: Obedient, commander: Commander) -> None:
    loop.deaf_to = {Opcode.START}
    with ThreadPoolExecutor(COMMAND_SLOTS + 5) as threads:
        answers = list(threads.map(commander.ask, [Opcode.START] * (COMMAND_SLOTS + 5)))
    assert {answer.code for answer in answers if isinstance(answer, Refusal)} == {Code.LOOP_SILENT}
    assert int(loop.written.block.fields["commands_posted"]) == COMMAND_SLOTS


def test_a_lost_loop_is_not_even_asked(loop: Obedient, commander: Commander) -> None:
    loop.__exit__()
    loop.beat(age_s=2.0)
    answer = commander.ask(Opcode.RESET)
    assert isinstance(answer, Refusal)
    assert answer.code is Code.LOOP_LOST
    assert int(loop.written.block.fields["commands_posted"]) == 0


def test_a_bank_is_filled_while_it_is_idle(loop: Obedient, commander: Commander) -> None:
    fields = loop.written.block.fields
    for active in (0, 1):
        fields["active_gains"] = active
        record = fields["gains"][active].copy()
        record["k_p"] = 0.25 + active
        in_force = fields["gains"][active].copy()
        assert adopt(loop.written.life(), commander, Opcode.ADOPT_GAINS, record) is None
        assert fields["gains"][1 - active]["k_p"] == 0.25 + active
        assert fields["gains"][active] == in_force
    assert loop.seen == [(Opcode.ADOPT_GAINS, 1), (Opcode.ADOPT_GAINS, 0)]
