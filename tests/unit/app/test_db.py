"""The database, of either kind: prepared on each connection, numbers given once, times kept."""

from datetime import UTC, datetime, timedelta, timezone

import pytest
from sqlalchemy import text
from sqlalchemy.exc import DBAPIError

from app.db import Database
from app.runs import repository
from app.runs.models import Document, Run, RunEvent
from tests.a_run import a_run


def test_each_connection_is_prepared(database: Database) -> None:
    connections = [database.engine.connect() for _ in range(3)]
    by_kind: dict[str, dict[str, object]] = {
        "sqlite": {
            "PRAGMA journal_mode": "wal",
            "PRAGMA synchronous": 2,
            "PRAGMA foreign_keys": 1,
            "PRAGMA busy_timeout": 15_000,
        },
        "postgresql": {"SHOW synchronous_commit": "on", "SHOW lock_timeout": "15s"},
    }
    expected = by_kind[database.engine.dialect.name]
    for connection in connections:
        assert {ask: connection.exec_driver_sql(ask).scalar() for ask in expected} == expected
        connection.close()


def test_the_number_of_a_run_is_never_given_again(database: Database) -> None:
    numbers = []
    for _ in range(3):
        with database.writing() as session:
            run = a_run(session)
            session.add(run)
        numbers.append(run.id)
        with database.writing() as session:
            session.delete(session.merge(run))
    assert numbers == [1, 2, 3]


def test_what_belongs_to_a_run_goes_with_it(database: Database) -> None:
    with database.writing() as session:
        run = a_run(session, tags=("a", "b"))
        session.add(run)
        session.flush()
        event = {"tick": 1, "kind": "k", "code": "c", "text": "t", "value": None, "limit": None}
        repository.add_events(session, [{"run_id": run.id, "sequence": 1, **event}] * 2)
    with database.writing() as session:
        session.delete(session.merge(run))
    with database.reading() as session:
        assert session.query(RunEvent).count() == 0
        assert repository.tags(session) == []


def test_a_transaction_that_fails_leaves_nothing(database: Database) -> None:
    def fail() -> None:
        with database.writing() as session:
            session.add(a_run(session))
            session.flush()
            session.execute(text("SELECT * FROM nowhere"))

    with pytest.raises(DBAPIError):
        fail()
    with database.reading() as session:
        assert session.query(Run).count() == 0
        assert session.query(Document).count() == 0


def test_what_reads_sees_one_moment(database: Database) -> None:
    with database.reading() as session:
        assert session.query(Run).count() == 0
        with database.writing() as other:
            other.add(a_run(other))
        assert session.query(Run).count() == 0
    with database.reading() as session:
        assert session.query(Run).count() == 1


def test_times_come_back_aware_and_the_same(database: Database) -> None:
    then = datetime(2026, 3, 1, 12, 0, 0, 123_456, tzinfo=timezone(timedelta(hours=9)))
    with database.writing() as session:
        session.add(a_run(session, started_at=then))
    with database.reading() as session:
        (run,) = session.query(Run).all()
        assert run.started_at == then
        assert run.started_at.utcoffset() == timedelta(0)


def test_a_tick_of_ten_years_is_kept(database: Database) -> None:
    tick = 10 * 365 * 86_400 * 4000
    with database.writing() as session:
        session.add(a_run(session, first_tick=tick, last_tick=tick + 1, ticks=tick))
    with database.reading() as session:
        (run,) = session.query(Run).all()
        assert (run.first_tick, run.last_tick, run.ticks) == (tick, tick + 1, tick)


def test_the_same_document_is_kept_once(database: Database) -> None:
    body = {"name": "Größte Kraft", "gains": [1.5, None, True], "nested": {"b": 1, "a": 2}}
    turned = {"nested": {"a": 2, "b": 1}, "gains": [1.5, None, True], "name": "Größte Kraft"}
    with database.writing() as session:
        numbers = {repository.freeze(session, one) for one in (body, turned, body)}
        other = repository.freeze(session, {**body, "name": "GRÖSSTE KRAFT"})
    assert len({*numbers, other}) == 2
    with database.reading() as session:
        document = session.get(Document, numbers.pop())
        assert document is not None
        assert document.body == body


def test_a_run_has_its_documents(database: Database) -> None:
    with database.writing() as session:
        session.add(a_run(session, started_at=datetime.now(UTC)))
    with database.reading() as session:
        (run,) = session.query(Run).all()
        assert (run.definition, run.rig) == ({"definition": 1}, {"rig": 1})
        assert run.prediction is None
