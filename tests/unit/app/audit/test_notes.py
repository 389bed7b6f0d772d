"""What is noted: it waits for nothing, is kept in a file, and entered in order exactly once."""

import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from app.audit import notes as module
from app.audit import repository
from app.audit.entry import act
from app.audit.notes import Notes
from app.audit.record import Entry, enter, note
from app.audit.service import Audit
from app.audit.spool import SPOOL_FILE, Spool
from app.db import Database
from tests.console_process import wait_for
from tests.unit.app.audit.entries import rows, some, targets

LAST = 50


@contextmanager
def held(database: Database) -> Iterator[None]:
    """Nobody else gets to write into the audit in this block."""
    with database.writing() as session:
        repository.append(session, [])
        yield


def lines(folder: Path) -> list[str]:
    """What is in the file."""
    path = folder / SPOOL_FILE
    return path.read_text().splitlines() if path.exists() else []


def expected(count: int = LAST) -> list[str]:
    return [entry.target for entry in some(count)]


def test_while_the_database_is_held_notes_wait_in_the_file(
    audit: Audit, database: Database, tmp_path: Path
) -> None:
    with held(database):
        for entry in some(LAST):
            note(entry)  # would never return, if it waited for the database that we hold
        wait_for(lambda: len(lines(tmp_path)) == LAST, "the lines in the file")
    wait_for(lambda: lines(tmp_path) == [], "an empty file")
    assert targets(database) == expected()
    assert audit.verify().intact


def test_what_is_noted_just_before_the_end_is_entered(audit: Audit, database: Database) -> None:
    for entry in some(LAST):
        note(entry)
    audit.close()
    assert targets(database) == expected()


NOTING = """
import os, signal, sys, time
from pathlib import Path
from app.audit.record import note
from app.audit.service import Audit
from app.audit.spool import SPOOL_FILE
from app.db import Database
from tests.unit.app.audit.entries import some
database, folder, count = Database(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
Audit(database, folder).open()
for entry in some(count):
    note(entry)
while not (folder / SPOOL_FILE).exists() or len((folder / SPOOL_FILE).read_bytes().splitlines()) < count:
    time.sleep(0.01)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.process
@pytest.mark.slow
def test_what_a_killed_console_has_noted_is_entered_by_the_next(
    database: Database, tmp_path: Path
) -> None:
    url = database.engine.url.render_as_string(hide_password=False)
    with held(database):
        command = [sys.executable, "-c", NOTING, url, str(tmp_path), str(LAST)]
        assert subprocess.run(command, check=False).returncode == -signal.SIGKILL
    assert (len(lines(tmp_path)), rows(database)) == (LAST, [])
    audit = Audit(database, tmp_path)
    audit.open()
    audit.close()
    assert (lines(tmp_path), targets(database)) == ([], expected())


def test_a_kill_between_entering_and_dropping_enters_nothing_twice(
    database: Database, tmp_path: Path
) -> None:
    acts = [act(entry, str(n)) for n, entry in enumerate(some(5))]
    Spool(tmp_path / SPOOL_FILE).append(acts)
    with database.writing() as session:
        enter(session, acts[:3])
    audit = Audit(database, tmp_path)
    audit.open()
    audit.close()
    assert (targets(database), lines(tmp_path)) == (expected(5), [])


def test_a_torn_line_costs_no_other(database: Database, tmp_path: Path) -> None:
    spool = Spool(tmp_path / SPOOL_FILE)
    spool.append([act(entry, entry.target) for entry in some(2)])
    whole = spool.path.read_bytes()
    spool.path.write_bytes(whole[:-20])
    again = Spool(spool.path)
    again.append([act(Entry("rig.stop", "rig"), "3")])
    assert [kept.target for kept in again.oldest(10).acts] == ["test-0", "rig"]


def test_more_than_there_is_room_for_is_counted(
    database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "MOST_WAITING", 5)
    monkeypatch.setattr(module, "AGAIN_S", 0.01)
    folder = tmp_path / "not there yet"
    notes = Notes(database, Spool(folder / SPOOL_FILE))
    notes.start()
    for entry in some(8):
        notes.take(act(entry, entry.target))
    folder.mkdir()
    wait_for(lambda: len(rows(database)) == 6, "what there was room for")
    notes.close()
    assert targets(database) == [*expected(5), "notes"]
    assert rows(database)[-1]["action"] == "audit.lost"
    assert rows(database)[-1]["after"] == '{"acts": 3}'
