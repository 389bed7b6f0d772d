"""A few drawn tests run live as predicted; `tests.process.predicted_runs` runs many."""

import pytest

from tests.process.predicted_runs import campaign

pytestmark = [pytest.mark.process, pytest.mark.slow]


def test_three_live_runs_are_as_predicted() -> None:
    compared = list(campaign(range(3)))
    assert sum(one.peak_n is not None for one in compared) >= 2
    assert all(one.holds for one in compared), compared
    assert sum(one.below for one in compared) > 0
