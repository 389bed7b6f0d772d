"""Backups: everything in one archive, of one moment, back in a directory of its own or not at all."""

import io
import shutil
import sqlite3
import tarfile
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from app.audit.entry import act
from app.audit.record import Entry
from app.audit.service import Audit
from app.audit.spool import SPOOL_FILE, Spool
from app.commands.backup import run_backup, run_restore
from app.commands.output import Exit
from app.db import Database
from app.recording.parts import part_paths, read_parts
from app.storage import backup as module
from app.storage.backup import Source, back_up, known_runs
from app.storage.restore import NotABackup, restore
from tests.unit.app.audit.entries import do, some, targets
from tests.unit.app.recording.recordings import end, record, records_of, ticks_with_gaps
from tests.unit.app.storage.stored_runs import FILES, REDUCED, database, enter, files

__all__ = ["database"]  # the fixture

BOXES = ("drills/4.parquet", "first-outs/3/box.parquet", "first-outs/waiting-1-2.parquet")
RECORDS = records_of(ticks_with_gaps(100, [(3000, 10), (2000, 0)]), 1)


@pytest.fixture
def data(database: Database, tmp_path: Path) -> Path:
    """A data directory with a run that is over, one under way and a time history."""
    runs_dir = tmp_path / "runs"
    enter(database, runs_dir, 2)
    under_way = enter(database, runs_dir, 1)
    shutil.rmtree(runs_dir / str(under_way))
    scratch = tmp_path / "scratch"
    file = record(scratch, RECORDS)
    file.abandon_part()
    file.folder.rename(runs_dir / str(under_way))
    histories = tmp_path / "histories"
    histories.mkdir()
    (histories / "flight.csv").write_text("0\n1\n")
    (histories / ".flight.csv.xyz").write_text("half")
    for name in (*BOXES, "first-outs/.box.xyz"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
    return tmp_path


def source(data: Path) -> Source:
    return Source(data, data / "forcerig.sqlite")


@pytest.mark.parametrize("name", ["b.tar", "b.tar.zst"])
def test_all_comes_back(data: Path, name: str) -> None:
    made = back_up(source(data), data / name)
    assert (made.runs, made.under_way) == (2, 1)
    assert made.bytes == (data / name).stat().st_size
    back = data / "back" / "data"
    restored = restore(data / name, back)
    assert restored.runs == 2
    assert files(back / "runs", 1) == set(FILES | REDUCED)
    assert (back / "runs/1/run.parquet").read_bytes() == (data / "runs/1/run.parquet").read_bytes()
    assert sum(batch.num_rows for batch in read_parts(back / "runs" / "2")) == len(RECORDS)
    assert [path.name for path in (back / "histories").iterdir()] == ["flight.csv"]
    with closing(sqlite3.connect(back / "forcerig.sqlite")) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    assert known_runs(back / "forcerig.sqlite") == [1, 2]
    assert [path.read_text() for path in map(back.joinpath, BOXES)] == list(BOXES)
    assert (
        sum(
            path.is_file() for name in ("drills", "first-outs") for path in (back / name).rglob("*")
        )
        == 3
    )
    of_runs = {"forcerig.sqlite", "histories", "runs"}
    assert {path.name for path in back.iterdir()} == of_runs | {"drills", "first-outs"}
    assert not list(data.glob(".*"))


def test_an_audit_that_comes_back_is_in_order(
    data: Path, database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    audit = Audit(database, data)
    audit.follow()
    do(database, *some(2))
    Spool(data / SPOOL_FILE).append([act(Entry("rig.stop", "rig"), "1")])
    snapshot = module.snapshot

    def while_the_console_runs(live: Path, copy: Path) -> None:
        audit.open()
        audit.close()
        do(database, *some(1))
        snapshot(live, copy)

    monkeypatch.setattr(module, "snapshot", while_the_console_runs)
    back_up(source(data), data / "b.tar")
    restore(data / "b.tar", data / "back")
    restored = Database(f"sqlite:///{data / 'back' / 'forcerig.sqlite'}")
    again = Audit(restored, data / "back")
    assert again.verify().intact
    again.open()
    again.close()
    assert targets(restored) == ["test-0", "test-1", "rig", "test-0"]
    assert again.verify().intact
    restored.close()


def test_a_part_that_grows_meanwhile_is_whole_up_to_a_batch(data: Path) -> None:
    (part,) = part_paths(data / "runs" / "2")
    part.write_bytes(part.read_bytes()[:-700])  # in the middle of a write
    back_up(source(data), data / "b.tar")
    restore(data / "b.tar", data / "back")
    kept = sum(batch.num_rows for batch in read_parts(data / "back" / "runs" / "2"))
    assert kept == len(RECORDS) - 200


def test_a_run_that_ends_while_it_is_read_comes_with_its_file(
    data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = data / "runs" / "2"
    found = module._found
    looked = 0

    def ending(run: Path, patterns: tuple[str, ...]) -> list[Path]:
        nonlocal looked
        paths = found(run, patterns)
        looked += run == folder
        if run == folder and looked == 1:
            scratch = record(data / "other", RECORDS)
            end(scratch)
            for path in scratch.folder.glob("*[nt]"):
                path.rename(folder / path.name)
            (folder / "part-0001.arrows").unlink()
        return paths

    monkeypatch.setattr(module, "_found", ending)
    made = back_up(source(data), data / "b.tar")
    assert (looked, made.under_way) == (2, 0)
    restore(data / "b.tar", data / "back")
    assert "run.parquet" in files(data / "back" / "runs", 2)


def test_the_database_is_of_one_moment(data: Path) -> None:
    with closing(sqlite3.connect(data / "forcerig.sqlite")) as writer:
        writer.execute("DELETE FROM runs WHERE id = 1")  # not committed
        back_up(source(data), data / "b.tar")
        writer.commit()
    restore(data / "b.tar", data / "back")
    assert known_runs(data / "back" / "forcerig.sqlite") == [1, 2]


def test_a_box_that_goes_meanwhile_is_no_trouble(
    data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    add = module._Made._add

    def going(made: module._Made, name: str, *rest: Any) -> None:
        (data / "first-outs/3/box.parquet").unlink(missing_ok=True)
        add(made, name, *rest)

    monkeypatch.setattr(module._Made, "_add", going)
    back_up(source(data), data / "b.tar")
    restore(data / "b.tar", data / "back")
    assert not (data / "back/first-outs/3/box.parquet").exists()


def test_without_samples(data: Path) -> None:
    whole = back_up(source(data), data / "whole.tar")
    made = back_up(Source(data, data / "forcerig.sqlite", with_samples=False), data / "b.tar")
    assert (made.runs, made.files) == (2, 1)
    assert made.bytes < whole.bytes
    assert restore(data / "b.tar", data / "back").runs == 2


def test_a_failure_leaves_nothing_behind(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (data / "b.tar").write_bytes(b"the backup of yesterday")

    def fails(*_: object) -> None:
        raise OSError("No space left on device")

    monkeypatch.setattr(module._Made, "folder", fails)
    assert run_backup(data / "b.tar", data, True, True) is Exit.BAD_INPUT
    assert (data / "b.tar").read_bytes() == b"the backup of yesterday"
    assert not list(data.glob(".*"))


def test_a_database_on_a_server_is_left_to_its_own_tools(
    data: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("FORCERIG_DATABASE_URL", "postgresql+psycopg://lab/forcerig")
    assert run_backup(data / "b.tar", data, True, False) is Exit.PASSED
    assert "pg_dump" in capsys.readouterr().out
    assert run_restore(data / "b.tar", data / "back", False) is Exit.PASSED
    assert "pg_restore" in capsys.readouterr().out
    assert files(data / "back" / "runs", 1) == set(FILES | REDUCED)


def archive_of(path: Path, members: dict[str, bytes]) -> Path:
    with tarfile.open(path, "w") as archive:
        for name, content in members.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    return path


def test_what_is_no_backup_is_refused_and_leaves_nothing(data: Path) -> None:
    back_up(source(data), data / "b.tar")
    content = (data / "b.tar").read_bytes()
    torn = data / "torn.tar"
    torn.write_bytes(content[: len(content) // 2])
    text = data / "text.tar"
    text.write_text("no archive at all" * 100)
    outside = archive_of(data / "outside.tar", {"../evil": b"x"})
    through = archive_of(data / "through.tar", {"first-outs/../../evil": b"x"})
    empty = archive_of(data / "empty.tar", {})
    newer = archive_of(data / "newer.tar", {"backup.json": b'{"format": 99}'})
    for archive in (torn, text, outside, through, empty, newer):
        with pytest.raises(NotABackup):
            restore(archive, data / "back")
        assert not (data / "back").exists()
    assert not (data.parent / "evil").exists()
    assert not [path for path in data.glob(".*") if path.is_dir()]


def test_a_directory_with_something_in_it_is_left_alone(data: Path) -> None:
    back_up(source(data), data / "b.tar")
    (data / "back").mkdir()
    restore(data / "b.tar", data / "back")
    with pytest.raises(NotABackup, match="is not empty"):
        restore(data / "b.tar", data / "back")
