"""The last of this folder: the run that was under way all the time, once everybody has asked."""

from collections import Counter

import pytest

from app.access.principal import Role
from tests.fuzz.under_way import UnderWay

pytestmark = [pytest.mark.process, pytest.mark.slow]


def test_the_run_goes_on_until_it_is_stopped_and_no_tick_is_missing(under_way: UnderWay) -> None:
    under_way.goes_on()
    assert "Traceback" not in under_way.console.said()
    assert under_way.console.command("stop").is_success
    run = under_way.console.ended_run(under_way.run_id)
    assert (run["outcome"], run["missing_ticks"]) == ("stopped", 0)
    assert run["ticks"] == run["last_tick"] - run["first_tick"] + 1


def test_what_was_asked_and_how_the_loop_kept_time(
    under_way: UnderWay,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Figures, and no limit: on a machine that is shared a time says nothing of the console."""
    before_s, since_s = under_way.quantiles_s()
    assert before_s is not None
    assert since_s is not None
    ticks = under_way.timing().ticks - under_way.before.ticks
    with capsys.disabled():
        print(f"\n{ticks} ticks while asked. p99 of a tick: {since_s * 1e6:.1f} µs, ", end="")
        print(f"{since_s / before_s:.2f} of what it was before")
        for role in (None, *Role):
            print(f"{'nobody' if role is None else role.word:9s}{_answers(under_way, role)}")


def _answers(under_way: UnderWay, role: Role | None) -> str:
    counts = Counter(
        {status: count for (who, status), count in under_way.asked.items() if who is role}
    )
    return f"{counts.total():5d} requests: " + ", ".join(
        f"{count} × {status}" for status, count in sorted(counts.items())
    )
