"""What a disk does to a run: it is full, it keeps less than it took, and the console stops the run for it."""

import errno
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.recording.outcome import Outcome
from app.recording.parts import PartWriter, part_paths
from app.recording.run_file import STOPPED_BECAUSE
from rtcore.codes import EventKind, Opcode
from rtcore.modes import Mode
from tests.unit.app.recording.paper_book import Desk, PaperBook, recorded_ticks
from tests.written_block import WrittenBlock


@pytest.fixture
def loop() -> WrittenBlock:
    return WrittenBlock()


@pytest.fixture
def book() -> PaperBook:
    return PaperBook()


def test_what_the_disk_did_not_keep_is_counted_as_missing(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    for _ in range(4):
        loop.ticks(50, run=1)
        desk.drain()
    (part,) = part_paths(tmp_path / "1")
    content = bytearray(part.read_bytes())
    content[len(content) * 5 // 8] ^= 1
    part.write_bytes(content)
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    recorded, _ = book.ends[1]
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(100))
    assert (recorded.ticks, recorded.missing_ticks) == (100, 100)
    assert len(list((tmp_path / "1").glob("*.damaged"))) == 1


@pytest.mark.parametrize("written_share", [0.0, 0.5, 1.0])
def test_a_full_disk_costs_no_tick_once_there_is_room(
    loop: WrittenBlock,
    book: PaperBook,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    written_share: float,
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    append = PartWriter.append

    def full(writer: PartWriter, records: Any) -> None:
        before = writer.path.stat().st_size
        append(writer, records)
        grown = writer.path.stat().st_size - before
        with writer.path.open("r+b") as file:
            file.truncate(before + int(written_share * grown))
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(PartWriter, "append", full)
    loop.ticks(100, run=1)
    for _ in range(3):
        desk.drain()
        assert desk.tape.trouble == "No space left on device"
    monkeypatch.undo()
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    assert desk.tape.trouble is None
    assert np.array_equal(recorded_ticks(tmp_path, 1), np.arange(200))
    assert book.ends[1][0].missing_ticks == 0
    assert book.ends[1][1].outcome is Outcome.COMPLETED


DISK_FULL = "Stopped: the disk was full"


@pytest.mark.parametrize("killed", [False, True])
@pytest.mark.parametrize("room", [False, True])
def test_a_run_that_the_console_stops_says_why(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path, *, killed: bool, room: bool
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    assert desk.tape.current is not None
    desk.tape.current.stopped_because(DISK_FULL)
    if not room:
        (tmp_path / "1" / STOPPED_BECAUSE).write_text("")
    loop.obey(Opcode.STOP)
    loop.go(Mode.STOPPING)
    if killed:
        desk.kill()
        desk = Desk(loop, tmp_path, book)
    loop.ticks(10, run=1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    _, ending = book.ends[1]
    told = room or not killed
    assert ending.outcome is Outcome.STOPPED
    assert ending.reason == (DISK_FULL if told else "Stopped by the operator")
    assert not (tmp_path / "1" / STOPPED_BECAUSE).exists()


def test_a_run_that_ended_before_the_console_could_stop_it_is_completed(
    loop: WrittenBlock, book: PaperBook, tmp_path: Path
) -> None:
    desk = Desk(loop, tmp_path, book)
    book.enter(1)
    loop.begin(1)
    loop.ticks(100, run=1)
    desk.drain()
    assert desk.tape.current is not None
    desk.tape.current.stopped_because(DISK_FULL)
    loop.report(EventKind.PROGRAM_ENDED, 1)
    loop.go(Mode.READY)
    loop.ticks(1)
    desk.drain()
    assert (book.ends[1][1].outcome, book.ends[1][1].reason) == (Outcome.COMPLETED, None)
