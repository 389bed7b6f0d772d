"""The envelope against the plain definition of it: least and greatest of each stretch of ticks."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.recording.bins import Columns, columns_of
from app.recording.samples import Levels, Samples, open_samples
from app.runs.envelope import Envelope, envelope
from tests.unit.app.recording.recordings import (
    CHANNELS,
    Records,
    end,
    least_and_greatest,
    record,
    records_of,
    ticks_with_gaps,
)

FIRST = 1000
STRETCHES = [(70_001, 3), (500, 9_000), (40, 1), (60_000, 200_000), (1, 300), (90_000, 0)]
POINTS = st.one_of(st.integers(1, 3), st.integers(1, 400), st.integers(1, 20_000))


class InMemory:
    """Samples without an overview, in chunks."""

    def __init__(self, records: Records, chunk: int) -> None:
        self.first_tick, self.last_tick = int(records["tick"][0]), int(records["tick"][-1])
        self._records, self._chunk = records, chunk

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        for start in range(0, len(self._records), self._chunk):
            part = self._records[start : start + self._chunk]
            yield columns_of(part[(part["tick"] >= first_tick) & (part["tick"] <= last_tick)])

    def levels(self) -> Levels:
        return ()


def agrees(found: Envelope, records: Records, first: int, last: int, points: int) -> None:
    """Every bin, by brute force over the ticks in it."""
    ticks, width = records["tick"], found.bin_ticks
    assert len(found.ticks) <= points
    assert (width == 1) == (last - first + 1 <= points)
    inside = ticks[(ticks >= first) & (ticks <= last)]
    if points > 1:
        starts = np.unique(inside // width) * width
        assert found.ticks.tolist() == np.maximum(starts, first).tolist()
    else:
        starts = np.array([first] if len(inside) else [])
        assert found.ticks.tolist() == starts.tolist()
    for i, start in enumerate(starts.tolist()):
        low, high = np.searchsorted(ticks, (max(start, first), min(start + width, last + 1)))
        for name in found.low:
            expected = least_and_greatest(records[name][low:high])
            got = found.low[name][i], found.high[name][i]
            assert np.array_equal(got, expected, equal_nan=True), (name, start)


@given(
    ticks=st.lists(st.integers(0, 400), min_size=1, max_size=200, unique=True),
    points=st.integers(1, 500),
    chunk=st.integers(1, 60),
    seed=st.integers(0, 1000),
)
def test_it_is_the_least_and_the_greatest_of_every_stretch(
    ticks: list[int], points: int, chunk: int, seed: int
) -> None:
    records = records_of(np.array(sorted(ticks)), seed)
    samples = InMemory(records, chunk)
    first, last = samples.first_tick, samples.last_tick
    agrees(envelope(samples, CHANNELS, first, last, points), records, first, last, points)


@pytest.fixture(scope="module", params=["over", "under way", "resumed"])
def run(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run."""
    runs_dir = tmp_path_factory.mktemp("runs")
    records = long_records()
    half = len(records) // 2
    if request.param == "resumed":  # after a kill the next app goes on in a part of its own
        record(runs_dir, records[:half]).abandon_part()
    file = record(runs_dir, records)
    if request.param == "over":
        end(file)
    file.abandon_part()
    return file.folder


def long_records() -> Records:
    return records_of(ticks_with_gaps(FIRST, STRETCHES), 1)


RECORDS = long_records()
LAST = int(RECORDS["tick"][-1])


def opened(folder: Path) -> Samples:
    samples = open_samples(folder)
    assert samples is not None
    assert samples.levels()
    return samples


@settings(max_examples=60)
@given(a=st.integers(FIRST, LAST), b=st.integers(FIRST, LAST), points=POINTS)
def test_an_overview_says_the_same_as_all_the_ticks(run: Path, a: int, b: int, points: int) -> None:
    first, last = min(a, b), max(a, b)
    agrees(envelope(opened(run), CHANNELS, first, last, points), RECORDS, first, last, points)


@pytest.mark.parametrize("points", [1, 2, 3, 40, 100, 1000])
def test_of_a_whole_run_too(run: Path, points: int) -> None:
    samples = opened(run)
    assert (samples.first_tick, samples.last_tick) == (FIRST, LAST)
    agrees(envelope(samples, CHANNELS, FIRST, LAST, points), RECORDS, FIRST, LAST, points)


def test_a_window_that_moves_shows_the_same_bins(run: Path) -> None:
    samples = opened(run)
    here = envelope(samples, CHANNELS, 10_000, 60_000, 100)
    there = envelope(samples, CHANNELS, 11_111, 61_111, 100)
    assert here.bin_ticks == there.bin_ticks
    both = np.intersect1d(here.ticks[1:-1], there.ticks[1:-1])
    assert len(both) > 90
    for name in CHANNELS:
        of_here = here.low[name][np.isin(here.ticks, both)]
        assert np.array_equal(of_here, there.low[name][np.isin(there.ticks, both)], equal_nan=True)


def test_an_overview_reads_only_the_ends_of_a_window(run: Path) -> None:
    samples = opened(run)
    read = 0

    class Counting:
        first_tick, last_tick = samples.first_tick, samples.last_tick

        def chunks(self, names: Sequence[str], first: int, last: int) -> Iterator[Columns]:
            nonlocal read
            read += last - first + 1
            return samples.chunks(names, first, last)

        def levels(self) -> Levels:
            return samples.levels()

    envelope(Counting(), CHANNELS, FIRST, LAST, 100)
    assert read < 2 * 4096 + 2 * 256


def test_nothing_in_the_window_gives_nothing() -> None:
    empty = envelope(InMemory(RECORDS, 1000), ["force_n"], 10, 5, 100)
    assert (len(empty.ticks), len(empty.low["force_n"])) == (0, 0)
