"""A loop that dies again and again is started more and more seldom."""

from itertools import pairwise

from app.link.backoff import FIRST_S, GOOD_LIFE_S, LONGEST_S, Backoff


def test_pauses_double_up_to_the_longest() -> None:
    backoff = Backoff()
    pauses = [backoff.died(1.0) for _ in range(12)]
    assert pauses[0] == FIRST_S
    assert all(b == min(2 * a, LONGEST_S) for a, b in pairwise(pauses))
    assert pauses[-1] == LONGEST_S


def test_a_good_life_begins_anew() -> None:
    backoff = Backoff()
    for _ in range(5):
        backoff.died(0.0)
    assert backoff.died(GOOD_LIFE_S) == FIRST_S
