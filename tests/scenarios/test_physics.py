"""The simulated rig against independent truth, on runs of the very tick: `forcerig bench physics`."""

from collections.abc import Callable, Iterable

import pytest

from bench import conservation, small_signal, static_law
from bench.balances import Balance, Fault
from bench.replays import SCENARIOS, Scenario, force_error, replayed
from bench.report import Figure
from rtcore.rig.plant import P_S
from tests.scenarios.test_paper import check

pytestmark = pytest.mark.slow

FORCE_ERROR = 5e-4  # of peak


@pytest.mark.parametrize(
    "part", [static_law.figures, small_signal.figures], ids=["static_law", "small_signals"]
)
def test_static_law_and_small_signals_are_met(part: Callable[[], Iterable[Figure]]) -> None:
    check(part())


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
def test_the_tick_follows_radau(scenario: Scenario) -> None:
    found = replayed(scenario.name)
    assert force_error(found.run.states, found.truth) < FORCE_ERROR


def sound(found: Balance) -> bool:
    return max(found) < conservation.LIMIT


@pytest.mark.parametrize("run", [conservation.moving, conservation.saturating])
def test_a_loaded_run_keeps_its_books(run: Callable[[], conservation.Stretch]) -> None:
    """The equations of motion, and the loop's own states."""
    assert sound(conservation.of_equations(run()))
    assert sound(conservation.of_tick(run()))


def test_pressurising_and_bleeding_keep_their_books() -> None:
    """The gas taking over from the hoses, and giving up again, included."""
    supply = conservation.pressurised().states[:, P_S]
    assert supply[0] < 1e6 < 20e6 < supply.max()
    assert supply[-1] < 1e6
    assert sound(conservation.of_equations(conservation.pressurised()))


@pytest.mark.parametrize("fault", list(conservation.SEEN_IN), ids=lambda f: f.name)
def test_a_planted_bug_breaks_the_books_of_the_very_run(fault: Fault) -> None:
    found = conservation.of_equations(conservation.moving(), fault)
    wrong = {book for book in Balance._fields if getattr(found, book) > conservation.LIMIT}
    assert wrong == set(conservation.SEEN_IN[fault])
