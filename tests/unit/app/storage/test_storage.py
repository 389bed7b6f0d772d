"""Room on the disk: what is refused, what is stopped, and with which numbers."""

from pathlib import Path

import pytest

from app.db import Database
from app.errors import Code, Refusal
from app.recording.recorder import RecorderState
from app.storage.schemas import StorageWord
from app.storage.service import Storage, StorageSettings
from app.storage.space import FILE_BYTES_PER_TICK, PART_BYTES_PER_TICK, Space
from app.storage.watcher import Watcher
from tests.unit.app.storage.stored_runs import FILES, REDUCED, database, enter

__all__ = ["database"]  # the fixture

PERIOD_S = 250e-6
RESERVE = 1_000_000
PER_S = (PART_BYTES_PER_TICK + FILE_BYTES_PER_TICK) / PERIOD_S
IDLE = RecorderState(False, 0, 0, None)


class Disk:
    """A disk with so much free, and a recorder."""

    def __init__(self, database: Database, folder: Path) -> None:
        self.free = 10**12
        self.recorder = IDLE
        self.database = database
        settings = StorageSettings(folder / "runs", PERIOD_S, RESERVE)
        self.storage = Storage(
            settings, database, lambda: self.recorder, lambda _: Space(10**13, self.free)
        )
        self.reasons: list[tuple[int, str]] = []
        self.stops = 0
        self.answer: Refusal | None = None
        self.watcher = Watcher(
            self.storage, lambda: self.recorder, lambda *why: self.reasons.append(why), self.stop
        )

    def stop(self) -> Refusal | str:
        self.stops += 1
        return self.answer or "done"

    def record(self, run_id: int, ticks: int) -> None:
        self.recorder = RecorderState(True, 0, 0, None, run_id, ticks)


@pytest.fixture
def disk(database: Database, tmp_path: Path) -> Disk:
    return Disk(database, tmp_path)


def test_a_run_that_fits_is_not_refused(disk: Disk) -> None:
    disk.free = round(3600 * PER_S) + RESERVE + 1
    assert disk.storage.refusal_for(3600.0) is None


def test_a_run_that_does_not_fit_is_refused_with_numbers(disk: Disk) -> None:
    disk.free = round(3600 * PER_S) + RESERVE - 1
    refusal = disk.storage.refusal_for(3600.0)
    assert refusal is not None
    assert refusal.code is Code.NO_SPACE
    assert refusal.detail.startswith("Cannot start: the run needs 2.2 GB on the disk and 2.2 GB")
    assert "enough for 60 min" in refusal.detail
    assert refusal.about == {"free_bytes": disk.free, "needed_bytes": disk.free + 1}


def test_both_the_parts_and_the_file_made_of_them_count(disk: Disk) -> None:
    disk.free = round(100 * PART_BYTES_PER_TICK / PERIOD_S) + RESERVE
    assert disk.storage.refusal_for(100.0) is not None


def test_what_the_last_run_took_is_what_the_next_will(disk: Disk, tmp_path: Path) -> None:
    assert disk.storage.bytes_per_s() == pytest.approx(PER_S)
    size = sum((FILES | REDUCED).values())
    enter(disk.database, tmp_path / "runs", 1, ticks=50_000)
    disk.storage.measure()
    per_tick = PART_BYTES_PER_TICK + max(1.0, size / 50_000)
    assert disk.storage.bytes_per_s() == pytest.approx(per_tick / PERIOD_S)


def test_room_is_low_in_good_time_and_full_before_it_is_gone(disk: Disk) -> None:
    for left_s, word in ((3601, StorageWord.OK), (3599, StorageWord.LOW), (0, StorageWord.FULL)):
        disk.free = round(left_s * PER_S) + RESERVE
        state = disk.storage.state()
        assert state.state is word
        assert state.seconds_left == pytest.approx(left_s, abs=0.1)


def test_the_file_of_the_run_under_way_has_its_room_kept(disk: Disk) -> None:
    disk.record(7, 1_000_000)
    disk.free = round(1_000_000 * FILE_BYTES_PER_TICK) + RESERVE + 1
    disk.watcher.look()
    assert disk.stops == 0
    disk.free -= 1
    disk.watcher.look()
    assert disk.stops == 1
    assert disk.reasons == [
        (7, "Stopped: the disk was full (33 MB left); all that was recorded is kept")
    ]


def test_a_run_is_stopped_once(disk: Disk) -> None:
    disk.record(7, 1000)
    disk.free = 0
    for _ in range(3):
        disk.watcher.look()
    assert disk.stops == 1
    disk.record(8, 1000)
    disk.watcher.look()
    assert disk.stops == 2


def test_a_stop_that_was_refused_is_given_again(disk: Disk) -> None:
    disk.record(7, 1000)
    disk.free = 0
    disk.answer = Refusal(Code.LOOP_SILENT, "The loop does not answer")
    disk.watcher.look()
    disk.answer = None
    disk.watcher.look()
    disk.watcher.look()
    assert disk.stops == 2


def test_nothing_is_stopped_where_nothing_is_recorded(disk: Disk) -> None:
    disk.free = 0
    disk.watcher.look()
    assert disk.stops == 0
