"""A few of the kills of `tests.process.kills`; a campaign of hundreds is run by hand."""

from pathlib import Path

import pytest

from tests.process.kills import campaign

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(600)]


def test_whatever_is_killed_and_when_no_run_and_no_tick_is_lost(tmp_path: Path) -> None:
    account = campaign(tmp_path, kills=6, seed=3)
    assert account.wrong == []
    assert account.ticks > 0
