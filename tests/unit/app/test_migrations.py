"""Migrations: up and down with what is in the tables, whole or not at all, wherever they are cut off."""

import json
import signal
import subprocess
import sys
from typing import Any

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from sqlalchemy import Connection, event, text

from app.db import Base, Database
from app.runs import finding, repository
from app.runs.finding import Sought
from app.runs.models import Run
from tests.a_run import a_run

FROZEN = ("definition", "plan", "controller", "interlocks", "rig", "conditions")
NUMBERS = (1, 2, 5)  # run 6 was deleted


def _declared(thing: Any, name: str | None, kind: str, reflected: bool, other: Any) -> bool:
    """What the models declare: not what each database indexes words with."""
    return not (name or "").startswith(("runs_words", "words_index"))


def test_the_migrations_make_the_tables_that_the_code_expects(empty_database: Database) -> None:
    empty_database.upgrade()
    empty_database.upgrade()  # the second start
    with empty_database.engine.connect() as connection:
        options = {"compare_type": True, "include_object": _declared}
        context = MigrationContext.configure(connection, opts=options)
        assert compare_metadata(context, Base.metadata) == []


def body(name: str, number: int) -> Any:
    """A document of a run; the settings are the same for all runs."""
    own = number if name in ("definition", "plan") else 0
    return [{"own": own}] if name == "conditions" else {"name": "Größte Kraft", "own": own}


INSERT = text(
    f"INSERT INTO runs (id, test_id, test_name, {', '.join(FROZEN)}, software_version, loop_life, "
    "period_ns, started_at, ticks, missing_ticks, outcome, verdict) VALUES (:id, 'hold', "
    f"'Hold 50 kN', {', '.join(f':{name}' for name in FROZEN)}, '0', '1-1', 250000, "
    "'2026-03-01 12:00:00', 4000, 0, 'completed', 'pass')"
)


def fill_0001(connection: Connection) -> None:
    """Runs as revision 0001 has them."""
    for number in (*NUMBERS, 6):
        documents = {name: json.dumps(body(name, number)) for name in FROZEN}
        connection.execute(INSERT, {"id": number, **documents})
    values = "(1, 7, 100, 'trip', 'c', 'text', 1.5, NULL)"
    connection.execute(text(f"INSERT INTO run_events VALUES {values}"))
    connection.execute(text("DELETE FROM runs WHERE id = 6"))
    if connection.dialect.name == "postgresql":
        connection.execute(text("SELECT setval('runs_id_seq', 6)"))


def check_0001(connection: Connection) -> None:
    """That they are as they were."""
    asked = ", ".join(FROZEN)
    rows = connection.execute(text(f"SELECT id, {asked} FROM runs ORDER BY id")).all()
    assert [row.id for row in rows] == list(NUMBERS)
    for row in rows:
        for name in FROZEN:
            found = getattr(row, name)
            found = json.loads(found) if isinstance(found, str) else found
            assert found == body(name, row.id)
    assert connection.execute(text("SELECT run_id, tick FROM run_events")).all() == [(1, 100)]


@pytest.fixture
def old_database(empty_database: Database) -> Database:
    """A database at revision 0001, with runs in it."""
    empty_database.upgrade("0001")
    with empty_database.engine.begin() as connection:
        fill_0001(connection)
    return empty_database


def test_up_nothing_is_lost_and_the_same_is_kept_once(old_database: Database) -> None:
    old_database.upgrade()
    with old_database.reading() as session:
        runs = session.query(Run).order_by(Run.id).all()
        assert [run.id for run in runs] == list(NUMBERS)
        for run in runs:
            for name in FROZEN:
                assert getattr(run, name) == body(name, run.id)
            assert (run.duration_s, run.operator, run.revision) == (1.0, "", None)
        assert len({run.rig_id for run in runs}) == 1
        assert [event.tick for event in repository.events(session, 1)] == [100]
        for sought in (Sought("hold 50"), Sought(outcome="completed", test_id="hold"), Sought("5")):
            assert finding.ids(session, sought, None, 1) == [5]
    with old_database.writing() as session:
        session.add(a_run(session))
    with old_database.reading() as session:
        assert max(run.id for run in session.query(Run).all()) == 7


def test_down_nothing_that_the_old_one_knew_is_lost(old_database: Database) -> None:
    with old_database.engine.connect() as connection:
        before = connection.execute(text("SELECT * FROM runs ORDER BY id")).mappings().all()
    old_database.upgrade()
    old_database.downgrade("0001")
    with old_database.engine.begin() as connection:
        check_0001(connection)
        after = connection.execute(text("SELECT * FROM runs ORDER BY id")).mappings().all()
        assert [_values(row) for row in after] == [_values(row) for row in before]
        new = dict.fromkeys(FROZEN, "{}")
        if connection.dialect.name == "sqlite":
            number = "(SELECT seq + 1 FROM sqlite_sequence WHERE name = 'runs')"
        else:
            number = "nextval('runs_id_seq')"
        connection.execute(text(str(INSERT).replace(":id", number)), new)
        assert connection.execute(text("SELECT max(id) FROM runs")).scalar() == 7
    old_database.upgrade()
    with old_database.reading() as session:
        assert session.query(Run).count() == 4
    old_database.downgrade("base")
    old_database.upgrade()


def _values(row: Any) -> dict[str, Any]:
    read = {name: row[name] for name in row}
    for name in FROZEN:
        read[name] = json.loads(read[name]) if isinstance(read[name], str) else read[name]
    return read


KILLED = """
import os, signal, sys
from sqlalchemy import event
from app.db import Database
database, left = Database(sys.argv[1]), int(sys.argv[2])
@event.listens_for(database.engine, "before_cursor_execute")
def before(*args):
    global left
    left -= 1
    if left == 0:
        os.kill(os.getpid(), signal.SIGKILL)
database.upgrade()
"""


def test_a_migration_that_is_killed_leaves_the_old_revision_working(
    old_database: Database,
) -> None:
    url = old_database.engine.url.render_as_string(hide_password=False)
    for statements in (5, 20, 40, 60):
        done = subprocess.run([sys.executable, "-c", KILLED, url, str(statements)], check=False)
        assert done.returncode == -signal.SIGKILL, statements
        with old_database.engine.begin() as connection:
            revision = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
            assert revision == "0001"
            check_0001(connection)
    if old_database.engine.dialect.name == "sqlite":
        with old_database.engine.connect() as connection:
            assert connection.exec_driver_sql("PRAGMA integrity_check").scalar() == "ok"
    old_database.upgrade()
    with old_database.reading() as session:
        assert session.query(Run).count() == len(NUMBERS)


def test_a_migration_that_fails_changes_nothing(old_database: Database) -> None:
    def broken(connection: Any, cursor: Any, statement: str, *rest: Any) -> None:
        if "runs_words" in statement:
            raise OSError("the disk is full")

    event.listen(old_database.engine, "before_cursor_execute", broken)
    with pytest.raises(OSError, match="disk"):
        old_database.upgrade()
    event.remove(old_database.engine, "before_cursor_execute", broken)
    with old_database.engine.begin() as connection:
        check_0001(connection)
    old_database.upgrade()


REVISIONS = ("interlocks", "controller", "rig_configuration")


def test_revisions_of_one_kind_outlive_the_tables_of_the_others(empty_database: Database) -> None:
    empty_database.upgrade()
    with empty_database.engine.begin() as connection:
        for kind in REVISIONS:
            values = f"(1, '{{\"of\": \"{kind}\"}}', 'Ann', 'Why not', '2026-03-01 12:00:00')"
            connection.execute(text(f"INSERT INTO {kind}_revisions VALUES {values}"))
    empty_database.downgrade("0007")
    empty_database.upgrade()
    with empty_database.engine.connect() as connection:
        counts = [
            connection.execute(text(f"SELECT count(*) FROM {kind}_revisions")).scalar()
            for kind in REVISIONS
        ]
        kept = connection.execute(text("SELECT document FROM interlocks_revisions")).scalar()
    assert counts == [1, 0, 0]  # what the old version had no table for is gone, and no more
    assert kept in ({"of": "interlocks"}, '{"of": "interlocks"}')
