"""Which samples go by the rule of retention, against a plain telling of it."""

from datetime import UTC, datetime, timedelta

from hypothesis import given
from hypothesis import strategies as st

from app.storage.rule import Kept, Limits, leaving

NOW = datetime(2026, 3, 1, tzinfo=UTC)


def run(number: int, age_days: float, size: int = 100) -> Kept:
    return Kept(number, "Step", NOW - timedelta(days=age_days), size)


def ids(limits: Limits, runs: list[Kept], tagged: frozenset[int] = frozenset()) -> list[int]:
    return [gone.id for gone in leaving(limits, runs, tagged, NOW)]


def test_nothing_goes_without_a_limit() -> None:
    assert ids(Limits(), [run(1, 10_000)]) == []


def test_what_is_older_goes_and_what_is_as_old_stays() -> None:
    runs = [run(1, 31), run(2, 30), run(3, 0)]
    assert ids(Limits(keep_days=30), runs) == [1]


def test_the_oldest_go_until_the_rest_fits() -> None:
    runs = [run(number, 10 - number) for number in (1, 2, 3, 4)]
    assert ids(Limits(keep_bytes=250), runs) == [1, 2]
    assert ids(Limits(keep_bytes=400), runs) == []
    assert ids(Limits(keep_bytes=0), runs) == [1, 2, 3, 4]


def test_a_tagged_run_keeps_its_samples_whatever_the_limits() -> None:
    runs = [run(1, 99), run(2, 98), run(3, 1)]
    assert ids(Limits(keep_days=30, keep_bytes=0), runs, frozenset({1})) == [2, 3]


def test_what_is_too_old_makes_room_for_what_is_not() -> None:
    runs = [run(1, 99), run(2, 20), run(3, 10)]
    gone = leaving(Limits(keep_days=30, keep_bytes=200), runs, frozenset(), NOW)
    assert [(g.id, g.reason) for g in gone] == [(1, "older than 30 days")]


@given(
    runs=st.lists(st.tuples(st.floats(0, 100), st.integers(0, 1000)), max_size=30),
    keep_bytes=st.integers(0, 10_000),
    tagged=st.frozensets(st.integers(0, 30), max_size=5),
)
def test_no_more_go_than_must(
    runs: list[tuple[float, int]], keep_bytes: int, tagged: frozenset[int]
) -> None:
    known = [run(i, 200 - i, size) for i, (_, size) in enumerate(runs)]
    gone = ids(Limits(keep_bytes=keep_bytes), known, tagged)
    left = sum(r.bytes for r in known if r.id not in gone)
    if left > keep_bytes:
        assert {r.id for r in known} - set(gone) <= tagged
    if gone:
        assert left + known[gone[-1]].bytes > keep_bytes
    assert not tagged & set(gone)
