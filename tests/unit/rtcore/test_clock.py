"""The compiled clock: the same one as Python's, and waits that signals cannot shorten."""

import signal
from collections.abc import Iterator
from resource import RUSAGE_SELF, getrusage
from time import monotonic_ns

import pytest

from rtcore.clock import now_ns, wait_until


def test_now_is_the_monotonic_clock_of_python() -> None:
    before = monotonic_ns()
    now = now_ns()
    assert before <= now <= monotonic_ns()


@pytest.mark.parametrize("margin_ns", [0, 60_000, 10_000_000])
def test_a_wait_never_ends_before_its_deadline(margin_ns: int) -> None:
    for ahead_ns in (1_000, 50_000, 2_000_000):
        deadline_ns = now_ns() + ahead_ns
        woke_ns = wait_until(deadline_ns, margin_ns)
        assert deadline_ns <= woke_ns <= now_ns()


@pytest.mark.parametrize("margin_ns", [0, 60_000])
def test_a_deadline_that_has_passed_is_not_waited_for(margin_ns: int) -> None:
    before = now_ns()
    assert before <= wait_until(before - 1_000_000_000, margin_ns) <= now_ns()


@pytest.fixture
def alarms() -> Iterator[list[int]]:
    """Signals a millisecond apart; the list grows with those that Python has handled."""
    seen: list[int] = []
    former = signal.signal(signal.SIGALRM, lambda number, _: seen.append(number))
    signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)
    yield seen
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, former)


@pytest.mark.parametrize("margin_ns", [0, 60_000])
def test_a_wait_that_signals_interrupt_sleeps_on(alarms: list[int], margin_ns: int) -> None:
    sleeps_before = getrusage(RUSAGE_SELF).ru_nvcsw
    deadline_ns = now_ns() + 50_000_000
    assert wait_until(deadline_ns, margin_ns) >= deadline_ns
    assert alarms
    # To watch the clock for the rest of the time would be one sleep, and a processor taken away.
    assert getrusage(RUSAGE_SELF).ru_nvcsw - sleeps_before > 2
