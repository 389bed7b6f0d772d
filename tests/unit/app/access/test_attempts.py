"""How often somebody may try to sign in, and how fast anybody may ask."""

from app.access.attempts import FORGOTTEN_S, Attempts
from app.access.pace import Pace
from app.errors import Code, Refusal


class Clock:
    """A clock that stands until it is moved."""

    def __init__(self) -> None:
        self.now_s = 1000.0

    def __call__(self) -> float:
        return self.now_s


def wait_in(refusal: Refusal | None) -> int:
    """How long a refusal says to wait, in seconds; 0 where there is none."""
    if refusal is None:
        return 0
    wait_s = refusal.about["retry_after_s"]
    assert isinstance(wait_s, int)
    assert f"{wait_s} s" in refusal.detail
    return wait_s


def waits(attempts: Attempts, clock: Clock, times: int, name: str, address: str) -> list[int]:
    """The wait before each of so many attempts, all in vain and each as early as it may be."""
    waited = []
    for i in range(times):
        wait_s = wait_in(attempts.begin(name.format(i), address.format(i)))
        if wait_s:
            clock.now_s += wait_s
            assert attempts.begin(name.format(i), address.format(i)) is None
        waited.append(wait_s)
    return waited


def test_the_wait_after_each_failure_doubles_up_to_a_minute() -> None:
    clock = Clock()
    found = waits(Attempts(clock), clock, 14, "kl", "10.0.0.{}")
    assert found == [0, 0, 0, 0, 0, 1, 2, 4, 8, 16, 32, 60, 60, 60]


def test_an_address_that_tries_many_names_waits_too() -> None:
    clock = Clock()
    found = waits(Attempts(clock), clock, 23, "name {}", "10.0.0.1")
    assert found == [0] * 20 + [1, 2, 4]


def test_the_same_name_in_other_letters_is_the_same_name() -> None:
    clock = Clock()
    attempts = Attempts(clock)
    for name in ("kl", "KL", "Kl", "kL", "kl"):
        assert attempts.begin(name, "10.0.0.1") is None
    refusal = attempts.begin("KL", "10.0.0.1")
    assert refusal is not None
    assert refusal.code is Code.TOO_MANY_ATTEMPTS


def test_what_comes_too_early_does_not_make_the_wait_longer() -> None:
    clock = Clock()
    attempts = Attempts(clock)
    waits(attempts, clock, 5, "kl", "10.0.0.1")
    assert [wait_in(attempts.begin("kl", "10.0.0.1")) for _ in range(50)] == [1] * 50
    clock.now_s += 1.0
    assert attempts.begin("kl", "10.0.0.1") is None


def test_many_at_once_are_counted_before_the_first_has_failed() -> None:
    attempts = Attempts(Clock())
    granted = [attempts.begin("kl", "10.0.0.1") is None for _ in range(100)]
    assert sum(granted) == 5


def test_success_is_forgiven_to_the_name_and_time_to_everybody() -> None:
    clock = Clock()
    attempts = Attempts(clock)
    waits(attempts, clock, 4, "kl", "10.0.0.1")
    attempts.succeeded("kl", "10.0.0.1")
    assert waits(attempts, clock, 6, "kl", "10.0.0.2") == [0, 0, 0, 0, 0, 1]
    clock.now_s += FORGOTTEN_S + 1.0
    assert waits(attempts, clock, 6, "kl", "10.0.0.2") == [0, 0, 0, 0, 0, 1]


def test_a_success_of_ones_own_does_not_open_an_address_for_guessing() -> None:
    clock = Clock()
    attempts = Attempts(clock)
    guesses = 0
    for i in range(60):  # a guess, then one's own name
        guesses += attempts.begin(f"name {i}", "10.0.0.1") is None
        if attempts.begin("own", "10.0.0.1") is None:
            attempts.succeeded("own", "10.0.0.1")
    assert guesses <= 20


def test_requests_come_back_at_a_steady_rate() -> None:
    clock = Clock()
    pace = Pace(per_s=10.0, at_once=5.0, clock_s=clock)
    assert [pace.take("a") is None for _ in range(7)] == [True] * 5 + [False] * 2
    assert pace.take("b") is None
    refusal = pace.take("a")
    assert refusal is not None
    assert (refusal.code, refusal.about) == (Code.TOO_MANY_REQUESTS, {"retry_after_s": 1})
    clock.now_s += 0.25
    assert [pace.take("a") is None for _ in range(3)] == [True, True, False]
    clock.now_s += 1e6
    assert [pace.take("a") is None for _ in range(6)] == [True] * 5 + [False]
