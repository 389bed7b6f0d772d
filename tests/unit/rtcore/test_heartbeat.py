"""The app's heartbeat: beats without the interpreter, but not for one that is gone."""

from collections.abc import Iterator
from contextlib import contextmanager
from sys import getswitchinterval, setswitchinterval
from threading import Thread
from time import monotonic_ns, sleep

import pytest

from rtcore.compiled import address_of
from rtcore.memory.heartbeat import Beater, keep_beating
from rtcore.memory.segment import Block, private_block

MS = 1_000_000


@pytest.fixture
def beater() -> Iterator[Beater]:
    made = Beater()
    yield made
    made.end()


@contextmanager
def beating(beater: Beater, patience_ns: int) -> Iterator[Block]:
    """A block that is beaten in every millisecond, by a thread that has begun to."""
    block = private_block(250_000, seconds=0.1)
    beater.turn_to(block)
    thread = Thread(target=keep_beating, args=(address_of(beater._record), MS, patience_ns))
    thread.start()
    try:
        yield block
    finally:
        beater.end()
        thread.join()


def newest(block: Block) -> int:
    return int(block.fields["app_heartbeat_ns"])


def spin_until_beaten(block: Block, after_ns: int) -> None:
    """Wait for a beat later than this without a word that would let another thread have the interpreter."""
    until = monotonic_ns() + 20_000 * MS
    while newest(block) <= after_ns:
        assert monotonic_ns() < until, "no beat came"


def test_it_beats_on_while_the_interpreter_is_busy(beater: Beater) -> None:
    with beating(beater, patience_ns=10**15) as block:
        spin_until_beaten(block, newest(block))  # from now on it is in the compiled loop
        usual_s = getswitchinterval()
        setswitchinterval(1000.0)  # this thread keeps the interpreter
        try:
            for _ in range(20):
                spin_until_beaten(block, newest(block))
        finally:
            setswitchinterval(usual_s)


def test_it_falls_silent_with_an_interpreter_that_does_not_show_itself(beater: Beater) -> None:
    patience_ns = 5 * MS
    with beating(beater, patience_ns) as block:
        first = newest(block)  # written when it was turned to the block
        sleep(10 * patience_ns * 1e-9)
        last, shown = newest(block), int(beater._record["shown_ns"][0])
        assert last <= max(first, shown + patience_ns)
        while newest(block) == last:  # it was there all the time
            beater.show()


def test_it_beats_in_no_block_that_it_has_been_turned_from(beater: Beater) -> None:
    first, second = private_block(250_000, 0.1), private_block(250_000, 0.1)
    beater.turn_to(first)
    last = int(first.fields["app_heartbeat_ns"])
    assert last > 0
    beater.turn_to(second)
    assert int(second.fields["app_heartbeat_ns"]) >= last
    thread = Thread(target=keep_beating, args=(address_of(beater._record), MS, 10**15))
    thread.start()
    while int(second.fields["app_heartbeat_ns"]) < last + 5 * MS:
        pass
    beater.turn_to(None)
    beater.end()
    thread.join()
    assert int(first.fields["app_heartbeat_ns"]) == last


def test_it_ends_when_told(beater: Beater) -> None:
    assert not beater.has_ended()
    beater.end()
    assert beater.has_ended()
    beater.keep_beating()  # returns at once
