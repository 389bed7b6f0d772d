"""Many writers at once, and what becomes of an entry whose change fails."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.exc import DBAPIError

from app.audit.actor import Actor, acting
from app.audit.record import Entry, note, record
from app.audit.service import Audit
from app.db import Database
from app.runs.models import Run
from tests.a_run import a_run
from tests.unit.app.audit.entries import do, rows, some, targets

WRITERS, EACH = 8, 15


def test_writers_at_once_make_one_chain(audit: Audit, database: Database) -> None:
    def write(writer: int) -> None:
        with acting(Actor(f"writer {writer}", "operator", f"token:{writer}")):
            for n in range(EACH):
                with database.writing() as session:
                    record(session, Entry("tests.save", f"{writer}/{n}"))
                note(Entry("rig.hold", "rig"))

    with ThreadPoolExecutor(WRITERS) as pool:
        list(pool.map(write, range(WRITERS)))
    audit.close()
    found = audit.verify()
    assert (found.intact, found.rows, found.behind) == (True, 2 * WRITERS * EACH, 0)
    for writer in range(WRITERS):
        mine = [row for row in rows(database) if row["who"] == f"writer {writer}"]
        saved = [row["target"] for row in mine if row["action"] == "tests.save"]
        assert saved == [f"{writer}/{n}" for n in range(EACH)]
        assert len(mine) == 2 * EACH


def test_consoles_and_commands_at_once_make_one_chain(
    audit: Audit, database: Database, tmp_path: Path
) -> None:
    beside = Database(database.engine.url.render_as_string(hide_password=False))
    Audit(beside, tmp_path).follow()
    for one in some(3):
        do(database, one)
        do(beside, one)
    beside.close()
    found = audit.verify()
    assert (found.intact, found.rows, found.behind) == (True, 6, 0)


def test_a_change_and_its_entry_are_both_there_or_neither(database: Database) -> None:
    def fail() -> None:
        with database.writing() as session:
            record(session, Entry("runs.start", "run 1"))
            session.add(a_run(session))
            session.flush()
            session.execute(text("SELECT * FROM nowhere"))

    with pytest.raises(DBAPIError):
        fail()
    assert rows(database) == []
    with database.writing() as session:
        record(session, Entry("runs.start", "run 1"))
        session.add(a_run(session))
    with database.reading() as session:
        assert session.query(Run).count() == 1
    assert targets(database) == ["run 1"]


def test_whoever_asks_is_named_and_the_console_where_nobody_does(database: Database) -> None:
    with acting(Actor("ada", "engineer", "session:7")):
        do(database, Entry("tests.save", "hold", "because"))
    do(database, Entry("tests.save", "hold", refused="edit_conflict"))
    named = [(row["who"], row["role"], row["credential"]) for row in rows(database)]
    assert named == [("ada", "engineer", "session:7"), ("console", "console", "console")]
    assert [row["outcome"] for row in rows(database)] == ["done", "refused: edit_conflict"]
