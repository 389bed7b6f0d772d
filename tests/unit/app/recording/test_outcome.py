"""How a run ended, from what the loop reported of it."""

from collections.abc import Callable

import pytest

from app.link.events import EventReader
from app.recording.outcome import Outcome, ending_of, last_tick_by_events
from rtcore.codes import EventKind, Opcode, Reply
from rtcore.modes import Mode
from tests.written_block import APP_SILENCE, FORCE_ERROR, FORCE_HINT, WrittenBlock

Step = Callable[[WrittenBlock], None]


def hint(loop: WrittenBlock) -> None:
    loop.trip(FORCE_HINT, 1200.0, 1000.0)


def error(loop: WrittenBlock) -> None:
    loop.trip(FORCE_ERROR, -6120.0, 6000.0)


def silence(loop: WrittenBlock) -> None:
    loop.trip(APP_SILENCE, 0.5, 0.5)


def ended(loop: WrittenBlock) -> None:
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.STOPPING)


def stop(loop: WrittenBlock) -> None:
    loop.obey(Opcode.STOP)
    loop.go(Mode.STOPPING)


def refused_stop(loop: WrittenBlock) -> None:
    loop.obey(Opcode.STOP, Reply.WRONG_MODE)


def shutdown(loop: WrittenBlock) -> None:
    loop.obey(Opcode.SHUTDOWN)
    loop.go(Mode.TRIPPED)


def tripped(loop: WrittenBlock) -> None:
    loop.go(Mode.TRIPPED)


def ready(loop: WrittenBlock) -> None:
    loop.go(Mode.READY)


ERROR = "Force error 6,120 N for 50 ms, limit 6,000 N"
SILENCE = "Console silent for 0.50 s, limit 0.50 s"


@pytest.mark.parametrize(
    ("happened", "outcome", "reason"),
    [
        ((ended, ready), Outcome.COMPLETED, None),
        ((hint, ended, ready), Outcome.COMPLETED, None),
        ((stop, ready), Outcome.STOPPED, "Stopped by the operator"),
        ((refused_stop, ended, ready), Outcome.COMPLETED, None),
        ((shutdown,), Outcome.STOPPED, "Shut down by the operator"),
        ((error, tripped), Outcome.TRIPPED, ERROR),
        ((hint, error, silence, tripped), Outcome.TRIPPED, ERROR),
        ((silence, error, tripped), Outcome.TRIPPED, SILENCE),
        ((ended, silence, tripped), Outcome.TRIPPED, SILENCE),
        ((stop, error, tripped), Outcome.TRIPPED, ERROR),
        ((error, shutdown), Outcome.TRIPPED, ERROR),
        ((), Outcome.INTERRUPTED, "How the run ended is not known: its end was not recorded"),
    ],
)
def test_how_a_run_ended(happened: tuple[Step, ...], outcome: Outcome, reason: str | None) -> None:
    loop = WrittenBlock()
    loop.begin(1)
    for step in happened:
        step(loop)
    ending = ending_of(EventReader(loop.life()).read())
    assert (ending.outcome, ending.reason) == (outcome, reason)


def test_the_last_tick_of_a_run_whose_end_was_lost() -> None:
    loop = WrittenBlock()
    loop.begin(1)
    loop.ticks(100)
    loop.go(Mode.STOPPING)
    loop.ticks(50)
    loop.go(Mode.READY)
    events = EventReader(loop.life()).read()
    assert last_tick_by_events(events, 10_000, 2000) == 149
    assert last_tick_by_events(events[:-1], 10_000, 2000) == 9999


def test_the_tail_after_a_trip_ends_early_where_the_rig_was_reset() -> None:
    loop = WrittenBlock()
    loop.begin(1)
    loop.ticks(100)
    loop.go(Mode.TRIPPED)
    tripped_only = EventReader(loop.life()).read()
    loop.ticks(300)
    loop.go(Mode.OFF)
    then_reset = EventReader(loop.life()).read()
    assert last_tick_by_events(tripped_only, 10_000, 2000) == 2100
    assert last_tick_by_events(then_reset, 10_000, 2000) == 399
