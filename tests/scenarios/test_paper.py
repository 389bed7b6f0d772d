"""What the paper shows, on the very tick of the loop: the figures of `forcerig bench paper`."""

from collections.abc import Callable, Iterable

import pytest

from app.analysis.goodness import goodness_of_fit
from bench import paper
from bench.disturbance import disturbance, fall_db, moved, rms
from bench.report import Figure

pytestmark = pytest.mark.slow


def check(figures: Iterable[Figure]) -> None:
    """Every figure of which something is asked is met, and something is asked."""
    asked = {f.name: f for f in figures if f.met is not None}
    assert asked
    missed = [f"{f.what}: {f.value:.5g} {f.unit}, {f.target}" for f in asked.values() if not f.met]
    assert missed == []


ROWS = [row for row in paper.TABLE if row.amplitude_n != paper.FOR_INFORMATION_N]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.amplitude_n:.0f} N")
def test_the_frequency_response_is_that_of_the_sheet(row: paper.Row) -> None:
    """Peak, minimum and 100 Hz within 0.1 dB and 1 Hz, by stepped sines."""
    figures = list(paper.response_figures(row))
    assert len(figures) == 5
    check(figures)


def test_on_a_mean_the_bypass_damps_less() -> None:
    check([paper.on_a_mean()])


@pytest.mark.parametrize(
    "part", [paper.step_figures, paper.authority_figures, paper.disturbance_figures]
)
def test_step_authority_and_disturbance_are_those_of_the_sheet(
    part: Callable[[], Iterable[Figure]],
) -> None:
    check(part())


def test_a_run_fits_itself_with_other_noise() -> None:
    """Eq (4) is forgiving: noise alone costs half a percent, and a run without the motion some five."""
    found = paper.goodness_figure().value
    assert found is not None
    assert 99.0 < found < 100.0
    still = goodness_of_fit(moved("COMP4", True).read_n, moved("COMP4", False).read_n)
    assert still < found - 2.0


def test_eight_hertz_tuning_and_a_broad_one_help_less_than_tuning_at_the_motions_frequency() -> (
    None
):
    left = {name: rms(disturbance(name)) for name in (None, "COMP4", "COMP8", "BROAD")}
    assert left["COMP4"] < left["BROAD"] < left["COMP8"] < left[None]
    assert fall_db("COMP4") == pytest.approx(paper.FALL_DB, abs=0.5)
