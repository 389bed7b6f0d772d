"""The database: migrated whole or not at all, prepared on each connection, numbers given once."""

from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.operations import Operations
from sqlalchemy import text
from sqlalchemy.exc import OperationalError
from sqlalchemy.orm import Session

from app.db import Base, Database
from app.runs import repository
from app.runs.models import Run


@pytest.fixture
def database(tmp_path: Path) -> Database:
    return Database(f"sqlite:///{tmp_path / 'test.sqlite'}")


FROZEN = ("definition", "plan", "controller", "interlocks", "rig", "conditions")


def a_run(session: Session, **values: Any) -> Run:
    return Run(
        **{f"{name}_id": repository.freeze(session, {name: 1}) for name in FROZEN},
        **{
            "test_id": "t",
            "test_name": "T",
            "software_version": "0",
            "loop_life": "1-1",
            "period_ns": 250_000,
            "started_at": datetime.now(UTC),
            **values,
        },
    )


def _declared(thing: Any, name: str | None, kind: str, reflected: bool, other: Any) -> bool:
    """What the models declare: not what each database indexes words with."""
    return not (name or "").startswith(("runs_words", "words_index"))


def test_the_migrations_make_the_tables_that_the_code_expects(database: Database) -> None:
    database.upgrade()
    database.upgrade()  # the second start
    with database.engine.connect() as connection:
        options = {"compare_type": True, "include_object": _declared}
        context = MigrationContext.configure(connection, opts=options)
        assert compare_metadata(context, Base.metadata) == []
    database.close()


def test_a_migration_that_breaks_off_changes_nothing(
    database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*args: object, **options: object) -> None:
        raise OSError("the power has gone")

    monkeypatch.setattr(Operations, "create_index", broken, raising=False)
    with pytest.raises(OSError, match="power"):
        database.upgrade()
    with database.engine.connect() as connection:
        assert connection.execute(text("SELECT name FROM sqlite_master")).all() == []
    monkeypatch.undo()
    database.upgrade()
    database.close()


def test_each_connection_is_prepared(database: Database) -> None:
    connections = [database.engine.connect() for _ in range(3)]
    for connection in connections:
        found = {
            name: connection.exec_driver_sql(f"PRAGMA {name}").scalar()
            for name in ("journal_mode", "synchronous", "foreign_keys", "busy_timeout")
        }
        assert found == {
            "journal_mode": "wal",
            "synchronous": 2,
            "foreign_keys": 1,
            "busy_timeout": 15_000,
        }
        connection.close()
    database.close()


def test_the_number_of_a_run_is_never_given_again(database: Database) -> None:
    database.upgrade()
    numbers = []
    for _ in range(3):
        with database.writing() as session:
            run = a_run(session)
            session.add(run)
        numbers.append(run.id)
        with database.writing() as session:
            session.delete(session.merge(run))
    assert numbers == [1, 2, 3]
    database.close()


def test_a_transaction_that_fails_leaves_nothing(database: Database) -> None:
    database.upgrade()

    def fail() -> None:
        with database.writing() as session:
            session.add(a_run(session))
            session.flush()
            session.execute(text("SELECT * FROM nowhere"))

    with pytest.raises(OperationalError):
        fail()
    with database.reading() as session:
        assert session.query(Run).count() == 0
    database.close()


def test_times_come_back_aware_and_the_same(database: Database) -> None:
    database.upgrade()
    then = datetime(2026, 3, 1, 12, 0, tzinfo=timezone(timedelta(hours=9)))
    with database.writing() as session:
        session.add(a_run(session, started_at=then))
    with database.reading() as session:
        (run,) = session.query(Run).all()
        assert run.started_at == then
        assert run.started_at.utcoffset() == timedelta(0)
    database.close()
