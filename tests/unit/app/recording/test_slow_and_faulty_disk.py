"""A disk that answers late, or with an error, and a book that is locked: samples go on being recorded."""

import errno
import os
import sqlite3
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from threading import Event
from typing import Any

import numpy as np
import pytest

import app.db as db
from app.db import Database
from app.recording.clerk import Clerk
from app.recording.outcome import Outcome
from app.recording.parts import PartWriter, part_paths, read_part
from app.recording.recorder import Recorder
from app.runs import repository
from app.runs.ledger import Ledger
from app.runs.models import Run
from rtcore.codes import EventKind
from rtcore.modes import Mode
from tests.unit.app.recording.paper_book import Desk, PaperBook, recorded_ticks
from tests.unit.app.recording.recordings import records_of
from tests.unit.app.storage.stored_runs import DOCUMENTS, NOW
from tests.written_block import PERIOD_NS, WrittenBlock

PATIENCE_S = 60.0


@pytest.fixture
def loop() -> WrittenBlock:
    return WrittenBlock()


def wait_for(condition: Callable[[], Any], what: str) -> None:
    give_up = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < give_up, what
        time.sleep(0.01)


class Bench:
    """A recorder and a clerk with their threads, over a book."""

    def __init__(self, loop: WrittenBlock, folder: Path, book: Any) -> None:
        self.clerk = Clerk(folder, book)
        self.recorder = Recorder(folder, self.clerk)
        self.life = loop.life()
        self.clerk.start()
        self.recorder.start()
        self.recorder.follow(self.life)

    def has(self, ticks: int) -> None:
        """Wait until so many ticks of the run under way are with the system."""
        wait_for(lambda: self.recorder.state().ticks == ticks, f"{ticks} ticks")

    def close(self) -> None:
        self.life.ended = True
        self.recorder.stop()
        self.clerk.stop()


def begin_run(loop: WrittenBlock) -> None:
    """With its first ticks: a recorder that finds none of a run takes it for never begun."""
    loop.begin(1)
    loop.ticks(100, run=1)


def end_run(loop: WrittenBlock) -> None:
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)


@pytest.fixture
def book() -> PaperBook:
    made = PaperBook()
    made.enter(1)
    return made


@pytest.fixture
def bench(loop: WrittenBlock, tmp_path: Path, book: PaperBook) -> Iterator[Bench]:
    begin_run(loop)
    made = Bench(loop, tmp_path, book)
    made.has(100)
    yield made
    made.close()


def test_an_error_of_the_disk_costs_no_tick(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """EIO in the middle of a batch: the part is given up, and what it lacks goes into the next."""
    desk = Desk(loop, tmp_path, book)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    write = os.write

    def broken(file: int, content: Any) -> int:
        write(file, content[: len(content) // 2])
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    with monkeypatch.context() as patch:
        patch.setattr(os, "write", broken)
        loop.ticks(100, run=1)
        desk.drain()
        assert desk.tape.trouble == "Input/output error"
    loop.ticks(100, run=1)
    desk.drain()
    assert not desk.tape.trouble
    end_run(loop)
    desk.drain()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(300))
    recorded, ending = book.ends[1]
    assert (recorded.missing_ticks, ending.outcome) == (0, Outcome.COMPLETED)


def test_a_sync_that_does_not_come_back_holds_up_no_tick(
    bench: Bench,
    loop: WrittenBlock,
    book: PaperBook,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """However long it takes: here until the run is over."""
    syncing, done = Event(), Event()

    def slow(file: int) -> None:
        syncing.set()
        done.wait(PATIENCE_S)

    monkeypatch.setattr(os, "fsync", slow)
    assert syncing.wait(PATIENCE_S)
    for ticks in range(200, 1001, 100):
        loop.ticks(100, run=1)
        bench.has(ticks)
    assert int(loop.block.fields["recorded"]) == loop.tick
    done.set()
    monkeypatch.undo()
    end_run(loop)
    wait_for(lambda: 1 in book.ends, "the end of the run")
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(1000))


def test_a_sync_that_fails_is_told_until_one_succeeds(
    bench: Bench, loop: WrittenBlock, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the system took may never get to the disk: whoever looks has to know."""

    def broken(file: int) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", broken)
        wait_for(lambda: bench.recorder.state().trouble == "Input/output error", "the trouble")
        loop.ticks(100, run=1)
        bench.has(200)
        assert bench.recorder.state().trouble == "Input/output error"
    wait_for(lambda: bench.recorder.state().trouble is None, "the end of the trouble")


def test_a_flipped_bit_in_the_last_batch_costs_that_batch_alone(tmp_path: Path) -> None:
    part = PartWriter(tmp_path)
    ends = []
    for first in range(0, 200, 50):
        part.append(records_of(np.arange(first, first + 50), seed=1))
        ends.append(part.size_bytes)
    part.close()
    (path,) = part_paths(tmp_path)
    content = bytearray(path.read_bytes())
    for at in range(ends[2] + 600, ends[3], 997):
        broken = bytearray(content)
        broken[at] ^= 1
        path.write_bytes(broken)
        ticks = [tick for batch in read_part(path) for tick in batch.column("tick").to_pylist()]
        assert ticks[:150] == list(range(150))
        assert ticks in (list(range(150)), list(range(200)))  # padding is nobody's


def enter(database: Database) -> None:
    """Run 1 is about to start."""
    with database.writing() as session:
        frozen = repository.freeze(session, {})
        run = Run(
            test_id="step",
            test_name="Step",
            **{f"{name}_id": frozen for name in DOCUMENTS},
            software_version="0",
            loop_life="1-42",
            period_ns=PERIOD_NS,
            started_at=NOW,
        )
        session.add(run)


@pytest.mark.parametrize("patience_ms", [1, db.BUSY_TIMEOUT_MS])
def test_a_locked_database_holds_up_no_tick(
    loop: WrittenBlock, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, patience_ms: int
) -> None:
    """Locked from the start of a run to after its end; what was to be written down is written then."""
    pragmas = [pragma for pragma in db._PRAGMAS if "busy_timeout" not in pragma]
    monkeypatch.setattr(db, "_PRAGMAS", (*pragmas, f"PRAGMA busy_timeout={patience_ms}"))
    file = tmp_path / "book.sqlite"
    database = Database(f"sqlite:///{file}")
    database.upgrade()
    enter(database)
    ledger = Ledger(database, tmp_path, lambda subject: None, lambda: None)
    begin_run(loop)
    with closing(sqlite3.connect(file, isolation_level=None)) as holder:
        holder.execute("BEGIN EXCLUSIVE")
        bench = Bench(loop, tmp_path, ledger)
        for ticks in range(600, 5101, 500):
            loop.ticks(500, run=1)
            bench.has(ticks)
        end_run(loop)
        wait_for(lambda: not bench.recorder.state().recording, "the end of the run")
        assert ledger.open_runs()[0].first_tick is None
        holder.execute("ROLLBACK")
    wait_for(lambda: not ledger.open_runs(), "the run's end in the book")
    bench.close()
    with database.reading() as session:
        run = session.get_one(Run, 1)
        assert (run.outcome, run.ticks, run.missing_ticks) == ("completed", 5100, 0)
    database.close()
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(5100))
