"""Each first-out is kept once, with every tick around it, whoever died meanwhile."""

from pathlib import Path

import pytest

from app.db import Database
from app.first_outs import files
from app.first_outs.account import Account
from rtcore.codes import EventKind, Opcode
from rtcore.modes import Mode
from tests.unit.app.first_outs.watched import AROUND_TICKS, RING_S, Watched
from tests.written_block import APP_SILENCE, FORCE_ERROR, FORCE_HINT, WrittenBlock


@pytest.fixture
def loop() -> WrittenBlock:
    return WrittenBlock(RING_S)


def trip(loop: WrittenBlock, detector: int = FORCE_ERROR) -> int:
    """The load is taken off; returns the tick of the first-out."""
    tick = loop.tick
    loop.trip(detector, 6100.0, 6000.0)
    loop.go(Mode.TRIPPED)
    loop.ticks(1)
    return tick


def reset(loop: WrittenBlock) -> None:
    loop.obey(Opcode.RESET)
    loop.go(Mode.OFF)
    loop.ticks(1)


def test_a_trip_is_kept_with_two_seconds_before_and_after(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    watched = Watched(loop.life(), database, tmp_path)
    loop.ticks(10_000)
    loop.begin(7)
    loop.ticks(2000, run=7)
    loop.trip(FORCE_HINT, 1001.0, 1000.0)
    loop.ticks(3, run=7)
    tick = trip(loop)
    loop.trip(APP_SILENCE, 0.51, 0.5)
    loop.ticks(AROUND_TICKS - 1)
    watched.look()
    assert watched.kept == []  # two seconds after it are not there yet
    loop.ticks(10)
    watched.look()
    (row,) = watched.kept
    assert (row.tick, row.run_id, row.mode_before) == (tick, None, "running")
    assert row.text == "Force error 6,100 N for 50 ms, limit 6,000 N"
    assert watched.ticks(row.id) == list(range(tick - AROUND_TICKS, tick + AROUND_TICKS + 1))
    account = Account.model_validate(row.account)
    assert [t.detector for t in account.trips] == ["force", "force_error", "app_silence"]
    assert [t.time_s for t in account.trips] == [-0.00075, 0.0, 0.00025]
    assert account.run_tick == 2003
    assert account == files.account_in(files.box_path(tmp_path, row.id))


def test_what_only_indicates_is_no_first_out(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    watched = Watched(loop.life(), database, tmp_path)
    loop.trip(FORCE_HINT, 1001.0, 1000.0)
    loop.ticks(AROUND_TICKS + 10)
    watched.look()
    assert watched.kept == []


def test_until_a_reset_nothing_else_comes_first(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    watched = Watched(loop.life(), database, tmp_path)
    loop.ticks(10)
    first = trip(loop)
    loop.ticks(5)
    trip(loop, APP_SILENCE)
    reset(loop)
    loop.ticks(20)
    second = trip(loop, APP_SILENCE)
    reset(loop)
    third = trip(loop)
    loop.ticks(AROUND_TICKS + 5)
    watched.look()
    assert [row.tick for row in watched.kept] == [first, second, third]
    assert [row.detector for row in watched.kept] == ["force_error", "app_silence", "force_error"]


def test_an_app_that_was_killed_catches_up_with_what_the_ring_holds(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    Watched(loop.life(), database, tmp_path).look()
    loop.ticks(9000)
    tick = trip(loop)
    slots = len(loop.block.ring)
    loop.ticks(slots - 4000)  # nobody is there; the ring goes over the beginning of it
    watched = Watched(loop.life(), database, tmp_path)
    watched.look()
    (row,) = watched.kept
    ticks = watched.ticks(row.id)
    assert ticks == list(range(ticks[0], tick + AROUND_TICKS + 1))
    assert tick - AROUND_TICKS < ticks[0] < tick
    assert Account.model_validate(row.account).missing_ticks == ticks[0] - tick + AROUND_TICKS
    again = Watched(loop.life(), database, tmp_path)
    again.look()
    assert len(again.kept) == 1  # an app that starts once more keeps it no second time


def test_of_a_trip_that_the_ring_has_forgotten_the_account_is_kept(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    trip(loop)
    loop.ticks(len(loop.block.ring) + AROUND_TICKS)
    watched = Watched(loop.life(), database, tmp_path)
    watched.look()
    (row,) = watched.kept
    assert (row.ticks, row.mode_before, row.detector) == (0, None, "force_error")
    assert files.samples_of(tmp_path, row.id) is None


def test_of_a_loop_that_died_what_there_is_is_kept(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    life = loop.life()
    watched = Watched(life, database, tmp_path)
    loop.ticks(100)
    tick = trip(loop)
    loop.ticks(49)
    watched.look()
    assert watched.kept == []
    life.ended = True
    watched.look()
    (row,) = watched.kept
    assert watched.ticks(row.id) == list(range(tick + 50))


def test_a_full_disk_is_told_and_tried_again(
    loop: WrittenBlock, database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    watched = Watched(loop.life(), database, tmp_path)
    loop.ticks(100)
    ticks = [trip(loop)]
    reset(loop)
    ticks.append(trip(loop, APP_SILENCE))
    loop.ticks(AROUND_TICKS)
    with monkeypatch.context() as patch:
        patch.setattr("app.first_outs.files.write_run", full)
        watched.look()
        assert watched.keeper.trouble == "No space left on device"
        loop.ticks(len(loop.block.ring))  # the ring forgets: what was copied stays
        watched.look()
        assert watched.kept == []
    watched.look()
    assert [row.tick for row in watched.kept] == ticks
    assert all(row.ticks > AROUND_TICKS for row in watched.kept)
    assert not watched.keeper.trouble


@pytest.mark.parametrize("moved", [False, True], ids=["set down", "moved, not committed"])
def test_a_kill_between_writing_a_box_and_entering_it_loses_nothing(
    loop: WrittenBlock,
    database: Database,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    moved: bool,
) -> None:
    class Killed(BaseException):
        pass

    def killed(waiting: Path, folder: Path, number: int) -> None:
        if moved:
            files.box_path(folder, number).parent.mkdir()
            waiting.replace(files.box_path(folder, number))
        raise Killed

    loop.ticks(100)
    tick = trip(loop)
    loop.ticks(AROUND_TICKS)
    monkeypatch.setattr("app.first_outs.files.put_in_place", killed)
    with pytest.raises(Killed):
        Watched(loop.life(), database, tmp_path).look()
    monkeypatch.undo()
    watched = Watched(WrittenBlock(RING_S).life(), database, tmp_path)  # the machine was restarted
    watched.look()
    (row,) = watched.kept
    assert (row.tick, len(watched.ticks(row.id))) == (tick, tick + AROUND_TICKS + 1)
    assert list(tmp_path.glob("waiting-*")) == []


def test_the_oldest_go_first_and_what_has_a_note_stays(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    watched = Watched(loop.life(), database, tmp_path, most=2)
    first = trip(loop)
    loop.ticks(AROUND_TICKS)
    watched.look()
    with database.writing() as session:
        session.merge(watched.kept[0]).note = "The hose burst"
    later = []
    for _ in range(3):
        reset(loop)
        later.append(trip(loop))
    loop.ticks(AROUND_TICKS)
    watched.look()
    assert [row.tick for row in watched.kept] == [first, later[-1]]
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_dir()) == sorted(
        str(row.id) for row in watched.kept
    )
    Watched(loop.life(), database, tmp_path, most=2).look()
    assert [row.tick for row in watched.kept] == [first, later[-1]]  # what is gone stays gone


def test_what_was_broken_and_commanded_before_it_is_kept(
    loop: WrittenBlock, database: Database, tmp_path: Path
) -> None:
    watched = Watched(loop.life(), database, tmp_path)
    loop.ticks(10)
    loop.report(EventKind.FAULT, 4, 50.0)
    loop.ticks(10)
    loop.begin(7)
    loop.ticks(100, run=7)
    loop.report(EventKind.FAULT, 1, 1.0)
    loop.obey(Opcode.HOLD)
    loop.go(Mode.HOLDING)
    loop.ticks(10, run=7)
    loop.trip(FORCE_ERROR, 6100.0, 6000.0)
    loop.go(Mode.TRIPPED)
    loop.ticks(AROUND_TICKS + 1, run=7)
    watched.look()
    (row,) = watched.kept
    account = Account.model_validate(row.account)
    assert (row.run_id, row.mode_before) == (7, "holding")
    assert account.injected == {"load_cell_noise": 50.0, "load_cell_open": 1.0}
    told = [(s.tick - 20, s.opcode, s.argument, s.value) for s in account.steps]
    assert told == [
        (0, "inject_fault", 4, 50.0),
        (100, "inject_fault", 1, 1.0),
        (100, "hold", 0, 0.0),
    ]
