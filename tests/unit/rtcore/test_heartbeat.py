"""The app's heartbeat: beats without the interpreter, but not for one that is gone."""

from collections.abc import Iterator
from threading import Thread
from time import monotonic_ns

import numpy as np
import pytest

from rtcore.compiled import address_of
from rtcore.memory.heartbeat import Beater, keep_beating
from rtcore.memory.segment import private_block

MS = 1_000_000
BEATS = 50


@pytest.fixture
def beater() -> Iterator[Beater]:
    made = Beater()
    yield made
    made.end()


def beats(beater: Beater, patience_ns: int) -> int:
    """The newest beat after many periods of a millisecond, all of them without the interpreter's word."""
    block = private_block(250_000, seconds=0.1)
    beater.turn_to(block)
    thread = Thread(target=keep_beating, args=(address_of(beater._record), MS, patience_ns))
    thread.start()
    waits = np.zeros(1, np.int64)
    until = monotonic_ns() + BEATS * MS
    while monotonic_ns() < until:
        waits += 1
    beater.end()
    thread.join()
    return int(block.fields["app_heartbeat_ns"])


def test_it_beats_on_while_the_interpreter_is_busy(beater: Beater) -> None:
    began = monotonic_ns()
    assert beats(beater, patience_ns=10**15) >= began + (BEATS - 1) * MS


def test_it_falls_silent_with_an_interpreter_that_does_not_show_itself(beater: Beater) -> None:
    newest = beats(beater, patience_ns=5 * MS)
    assert newest <= int(beater._record["shown_ns"][0]) + 5 * MS


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
