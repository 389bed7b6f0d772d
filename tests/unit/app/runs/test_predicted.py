"""Where on a run's time its prediction lies: a hold, and the fade after it, put it off, and a skip ends it."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from app.analysis.walk import HOLD_FADE_S
from app.prediction.series_file import remove_series, write_series
from app.prediction.through import Series
from app.runs.models import RunEvent
from app.runs.predicted import COLUMNS, Passage, PredictedSamples, passages

FADE = round(HOLD_FADE_S / 250e-6)


def _mode(tick: int, code: str) -> RunEvent:
    return cast(RunEvent, SimpleNamespace(kind="mode", tick=tick, code=code))


def test_without_a_hold_it_lies_where_it_was_predicted() -> None:
    events = [_mode(500, "running"), _mode(4500, "stopping")]
    assert passages(events, 500, 6000, FADE) == [Passage(0, 6000, 0)]


def test_a_hold_and_its_fade_put_it_off() -> None:
    events = [_mode(100, "running"), _mode(1100, "holding"), _mode(4100, "running")]
    # held from tick 1000 to 4000 of the run; fading in, the program stands still for 999 ticks more
    again = 4000 + FADE - 1
    expected = [Passage(0, 1000, 0), Passage(again, 9000, again - 1000)]
    assert passages(events, 100, 9000, FADE) == expected


def test_a_short_hold_fades_in_as_long_as_it_faded_out() -> None:
    events = [_mode(1000, "holding"), _mode(1010, "running")]
    assert passages(events, 0, 3000, FADE)[1].first == 1010 + 10 - 1


def test_a_run_that_ended_in_a_hold_has_nothing_after_it() -> None:
    events = [_mode(1000, "holding"), _mode(2000, "stopping")]
    assert passages(events, 0, 5000, FADE) == [Passage(0, 1000, 0)]


def _skipped(tick: int, ticks: int) -> RunEvent:
    event = SimpleNamespace(kind="skipped", tick=tick, code="3", value=float(ticks))
    return cast(RunEvent, event)


def test_once_something_was_skipped_nothing_is_as_predicted() -> None:
    events = [_mode(100, "running"), _skipped(1100, 400), _skipped(2100, 250)]
    assert passages(events, 100, 9000, FADE) == [Passage(0, 1000, 0)]
    held = [_mode(1000, "holding"), _mode(1010, "running"), _skipped(3000, 9)]
    assert passages(held, 0, 9000, FADE) == [Passage(0, 1000, 0), Passage(1019, 3000, 19)]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    force_n = np.arange(200_000, dtype=np.float32)
    write_series(tmp_path / "7", Series(force_n, -force_n), 150_000)
    return tmp_path / "7"


def _read(samples: PredictedSamples, first: int, last: int) -> tuple[Any, Any, Any]:
    chunks = list(samples.chunks(COLUMNS, first, last))
    return tuple(np.concatenate([chunk[name] for chunk in chunks]) for name in ("tick", *COLUMNS))  # type: ignore[return-value]


def test_every_tick_of_the_file_is_found_at_its_place(folder: Path) -> None:
    where = [Passage(0, 70_000, 0), Passage(100_000, 300_000, 30_000)]
    samples = PredictedSamples(folder / "predicted.parquet", where)
    ticks, force_n, displacement_m = _read(samples, 65_000, 110_000)
    assert np.array_equal(ticks, np.r_[65_000:70_000, 100_000:110_001])
    assert np.array_equal(force_n, np.r_[65_000:70_000, 70_000:80_001])
    assert np.array_equal(displacement_m, -force_n)
    assert _read(samples, 0, 10**6)[1][-1] == 149_999  # and no further than was predicted


def test_what_was_written_can_be_removed_and_what_is_others_stays(folder: Path) -> None:
    (folder / "run.parquet").touch()
    remove_series(folder)
    assert [path.name for path in folder.iterdir()] == ["run.parquet"]
    (folder / "run.parquet").unlink()
    remove_series(folder)
    assert not folder.exists()
