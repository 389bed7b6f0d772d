"""Killed at any moment between the last tick and the last clean-up, a run is filed by the next app."""

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from app.recording import files, live_overview, part_index
from app.recording.clerk import Clerk
from app.recording.extent import extent_of
from app.recording.live_overview import read_live_overview
from app.recording.outcome import LOOP_ENDED, UNKNOWN, Ending, Outcome
from app.recording.parts import part_paths, read_parts
from app.recording.recovery import close_orphans, sweep
from app.recording.run_file import Recorded, RunFile
from app.recording.samples import open_samples
from tests.unit.app.recording.paper_book import PaperBook
from tests.unit.app.recording.recordings import end, record, recorded_of, records_of

TICKS = np.arange(1000, 21_000)
RECORDS = records_of(TICKS, 1)


class Killed(BaseException):
    """The process is gone: nothing is cleaned up."""


class Countdown:
    """Kills at the n-th of the steps that reach the disk or the book."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, at: int) -> None:
        self.left = at
        self.dead = False
        monkeypatch.setattr(tempfile, "mkstemp", self.step(tempfile.mkstemp))
        monkeypatch.setattr(os, "fsync", self.step(os.fsync))
        monkeypatch.setattr(Path, "replace", self.step(Path.replace))
        monkeypatch.setattr(Path, "unlink", self.step(Path.unlink))
        monkeypatch.setattr(PaperBook, "ended", self.step(PaperBook.ended))

    def step(self, real: Any) -> Any:
        def killing(*arguments: Any, **options: Any) -> Any:
            self.left -= 1
            self.dead = self.dead or self.left < 0
            if self.dead:
                raise Killed
            return real(*arguments, **options)

        return killing


@pytest.fixture
def book() -> PaperBook:
    book = PaperBook()
    book.enter(1, first_tick=1000)
    return book


def start_again(runs_dir: Path, book: PaperBook) -> None:
    """What a start of the console does, without a loop."""
    clerk = Clerk(runs_dir, book)
    sweep(runs_dir, clerk)
    close_orphans(runs_dir, clerk, None)
    clerk.work_off()


def is_filed_whole(folder: Path) -> None:
    """The file with every tick, its overview, and nothing else."""
    names = {path.name for path in folder.iterdir()}
    assert names == {"run.parquet", *(f"overview-{i}.bin" for i in range(3))}
    ticks = pq.read_table(folder / "run.parquet", columns=["tick"])["tick"].to_numpy()
    assert np.array_equal(ticks, TICKS)
    samples = open_samples(folder)
    assert samples is not None
    assert len(samples.levels()) == 3


@pytest.mark.parametrize("at", range(30))
def test_killed_while_a_run_is_filed(
    tmp_path: Path, book: PaperBook, monkeypatch: pytest.MonkeyPatch, at: int
) -> None:
    file = record(tmp_path, RECORDS)
    file.abandon_part()
    with monkeypatch.context() as patch:
        countdown = Countdown(patch, at)
        clerk = Clerk(tmp_path, book)
        clerk.ended(1, recorded_of(file), Ending(Outcome.COMPLETED, None))
        with suppress(Killed):
            clerk.work_off()
    assert countdown.dead == (at < 22)
    with monkeypatch.context() as patch, suppress(Killed):  # and the next one too, a bit later
        Countdown(patch, at // 2)
        start_again(tmp_path, book)
    start_again(tmp_path, book)
    recorded, ending = book.ends[1]
    assert recorded == Recorded(1000, 20_999, 20_000, 0)
    filed = at >= 15  # once there is a file, it says how the run ended
    assert ending.outcome is (Outcome.COMPLETED if filed else Outcome.INTERRUPTED)
    is_filed_whole(file.folder)


def test_what_a_kill_left_of_a_file_that_was_being_written_goes(
    tmp_path: Path, book: PaperBook
) -> None:
    file = record(tmp_path, RECORDS)
    end(file)
    (file.folder / ".run.parquet.x1y2z3").write_bytes(b"half of it")
    start_again(tmp_path, book)
    is_filed_whole(file.folder)


# ---- while it is recorded ----


def cut(path: Path, lost: int) -> None:
    """As a kill in the middle of a write leaves it."""
    path.write_bytes(path.read_bytes()[:-lost])


@pytest.mark.parametrize("lost", [1, 100, 5000, 50_000])
@pytest.mark.parametrize("what", ["part", "index", "rows"])
def test_a_torn_end_of_anything_costs_no_tick_that_the_part_has(
    tmp_path: Path, what: str, lost: int
) -> None:
    file = record(tmp_path, RECORDS[:15_000])
    (part,) = part_paths(file.folder)
    torn = {
        "part": [part],
        "index": [part_index.index_path(part)],
        "rows": [live_overview.rows_path(file.folder, i) for i in range(3)],
    }[what]
    file.abandon_part()
    for path in torn:
        cut(path, min(lost, path.stat().st_size))
    kept = sum(batch.num_rows for batch in read_parts(file.folder))
    assert kept > 14_000 - 5 * lost if what == "part" else kept == 15_000
    assert extent_of(file.folder).ticks == kept
    file = record(tmp_path, RECORDS)
    end(file)
    for path in (*part_paths(file.folder), *file.folder.glob("*.rows")):
        assert path.exists()
    files.remove_parts(file.folder)
    is_filed_whole(file.folder)


def test_an_index_that_is_ahead_of_its_part_is_not_believed(tmp_path: Path) -> None:
    """After a power cut: the index reached the disk, the last batches did not."""
    file = record(tmp_path, RECORDS)
    file.abandon_part()
    (part,) = part_paths(file.folder)
    for keep in (0.3, 0.7, 0.95):
        content = part.read_bytes()
        whole = int(keep * len(content))
        part.write_bytes(content[:whole] + bytes(len(content) - whole))  # zeros where data were due
        readable = sum(batch.num_rows for batch in read_parts(file.folder))
        assert extent_of(file.folder).ticks == readable
        part.write_bytes(content)


@contextmanager
def full_disk(monkeypatch: pytest.MonkeyPatch, *, only_rows: bool) -> Iterator[None]:
    """No more than half of anything is taken."""
    write = live_overview._write_whole

    def half(file: Any, content: bytes) -> None:
        write(file, content[: len(content) // 2])
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(live_overview, "_write_whole", half)
        if not only_rows:
            patch.setattr(part_index.IndexWriter, "add", lambda *_: half(_, b""))
        yield


@pytest.mark.parametrize("only_rows", [True, False])
def test_no_room_for_index_or_overview_costs_no_tick(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, only_rows: bool
) -> None:
    file = RunFile.open(1, tmp_path, 1000)
    for start in range(0, len(RECORDS), 400):
        with full_disk(monkeypatch, only_rows=only_rows) if start in SCARCE else nullcontext():
            file.append(RECORDS[start : start + 400])
    levels = read_live_overview(file.folder)
    assert levels is not None
    assert levels[0].to_tick > TICKS[-1] - 2 * live_overview.AT_ONCE_TICKS
    assert file.extent.ticks == len(TICKS)
    end(file)
    files.remove_parts(file.folder)
    is_filed_whole(file.folder)


SCARCE = range(4000, 9000)


@pytest.mark.parametrize("damage", ["missing", "torn", "flipped", "foreign"])
def test_a_damaged_overview_is_made_again(tmp_path: Path, damage: str) -> None:
    file = record(tmp_path, RECORDS)
    end(file)
    path = file.folder / "overview-0.bin"
    whole = path.read_bytes()
    if damage == "missing":
        path.unlink()
    elif damage == "torn":
        path.write_bytes(whole[:-100])
    elif damage == "flipped":
        path.write_bytes(whole[:-5000] + bytes([whole[-5000] ^ 1]) + whole[-4999:])
    else:
        path.write_bytes(b"\1" + whole[1:])
    samples = open_samples(file.folder)
    assert samples is not None
    assert len(samples.levels()) == 3
    assert path.read_bytes() == whole


def test_a_run_whose_end_was_not_known_is_filed_as_interrupted(
    tmp_path: Path, book: PaperBook
) -> None:
    record(tmp_path, RECORDS).abandon_part()
    start_again(tmp_path, book)
    assert book.ends[1] == (Recorded(1000, 20_999, 20_000, 0), LOOP_ENDED)


def test_a_file_says_how_its_run_ended_where_the_book_has_not_heard(
    tmp_path: Path, book: PaperBook
) -> None:
    file = record(tmp_path, RECORDS)
    recorded = end(file)
    files.remove_parts(file.folder)
    start_again(tmp_path, book)
    assert book.ends[1] == (recorded, UNKNOWN)
