"""The chain: whatever is done to the rows behind the console's back, verification names the first."""

import shutil
import sqlite3
import tempfile
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sqlalchemy import text
from sqlalchemy.exc import DBAPIError

from app.audit.chain import hash_of
from app.audit.head import HEAD_FILE
from app.audit.models import AuditRow
from app.audit.record import Entry, record
from app.audit.schemas import Verification
from app.audit.service import Audit
from app.db import Database
from tests.unit.app.audit.entries import ENTRIES, do, rows, some

CHANGES = settings(max_examples=25)
COLUMNS = [column.key for column in AuditRow.__table__.columns if column.key != "id"]
Cursor = sqlite3.Connection


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data directory whose database has its tables, to copy."""
    folder = tmp_path_factory.mktemp("empty")
    database = Database(f"sqlite:///{folder / 'forcerig.sqlite'}")
    database.upgrade()
    database.close()
    return folder


@contextmanager
def kept(empty: Path, entries: list[Entry]) -> Iterator[tuple[Database, Path]]:
    """A data directory in which these were entered."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(shutil.copytree(empty, Path(folder) / "data"))
        database = Database(f"sqlite:///{data / 'forcerig.sqlite'}")
        Audit(database, data).follow()
        with database.writing() as session:
            for entry in entries:
                record(session, entry)
        yield database, data
        database.close()


def tamper(data: Path, work: Callable[[Cursor], object]) -> None:
    """Change the rows as somebody would who may write the file."""
    with closing(sqlite3.connect(data / "forcerig.sqlite")) as connection, connection:
        for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'"):
            if name.startswith("audit"):
                connection.execute(f"DROP TRIGGER {name}")
        work(connection)


def verified(data: Path) -> Verification:
    """As the command looks, with nothing in memory."""
    database = Database(f"sqlite:///{data / 'forcerig.sqlite'}")
    try:
        return Audit(database, data).verify()
    finally:
        database.close()


LISTS = st.lists(ENTRIES, min_size=2, max_size=6)


@CHANGES
@given(entries=LISTS)
def test_what_is_entered_is_in_order(empty: Path, entries: list[Entry]) -> None:
    with kept(empty, entries) as (_, data):
        found = verified(data)
        assert (found.intact, found.rows, found.broken_id) == (True, len(entries), None)


@CHANGES
@given(entries=LISTS, data=st.data())
def test_a_row_that_is_changed_is_named(empty: Path, entries: list[Entry], data: Any) -> None:
    number = data.draw(st.integers(1, len(entries)))
    column = data.draw(st.sampled_from(COLUMNS))
    value = data.draw(st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=5))
    with kept(empty, entries) as (database, folder):
        before = rows(database)[number - 1][column]
        tamper(
            folder,
            lambda c: c.execute(f"UPDATE audit SET {column} = ? WHERE id = ?", (value, number)),
        )
        found = verified(folder)
        assert found.intact is (before == value)
        assert found.broken_id == (None if before == value else number)


@CHANGES
@given(entries=LISTS, data=st.data())
def test_rows_that_are_removed_are_named(empty: Path, entries: list[Entry], data: Any) -> None:
    first = data.draw(st.integers(1, len(entries)))
    last = data.draw(st.integers(first, len(entries)))
    with kept(empty, entries) as (_, folder):
        delete = "DELETE FROM audit WHERE id BETWEEN ? AND ?"
        tamper(folder, lambda c: c.execute(delete, (first, last)))
        found = verified(folder)
        assert (found.intact, found.broken_id) == (False, first)


@CHANGES
@given(entries=LISTS, data=st.data())
def test_rows_that_are_exchanged_are_named(empty: Path, entries: list[Entry], data: Any) -> None:
    numbers = st.integers(1, len(entries))
    first, last = sorted(
        data.draw(st.tuples(numbers, numbers).filter(lambda pair: pair[0] != pair[1]))
    )
    with kept(empty, entries) as (_, folder):

        def swap(connection: Cursor) -> None:
            for old, new in ((first, -1), (last, first), (-1, last)):
                connection.execute("UPDATE audit SET id = ? WHERE id = ?", (new, old))

        tamper(folder, swap)
        found = verified(folder)
        assert (found.intact, found.broken_id) == (False, first)


def read(connection: Cursor) -> list[dict[str, Any]]:
    connection.row_factory = sqlite3.Row
    return [dict(row) for row in connection.execute("SELECT * FROM audit ORDER BY id")]


def write(connection: Cursor, table: list[dict[str, Any]]) -> None:
    connection.execute("DELETE FROM audit")
    for row in table:
        marks = ", ".join(f":{name}" for name in row)
        connection.execute(f"INSERT INTO audit ({', '.join(row)}) VALUES ({marks})", row)


def rechained(table: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Rows with numbers and hashes that fit together, as somebody would make them who knows how."""
    previous = ""
    for number, row in enumerate(table, 1):
        row |= {"id": number, "previous_hash": previous}
        row["hash"] = previous = hash_of(row)
    return table


@CHANGES
@given(entries=LISTS, data=st.data())
def test_a_row_that_is_put_in_is_named(empty: Path, entries: list[Entry], data: Any) -> None:
    place = data.draw(st.integers(0, len(entries)))
    with kept(empty, entries) as (_, folder):

        def put_in(connection: Cursor) -> None:
            table = read(connection)
            later = [row | {"id": row["id"] + 1} for row in table[place:]]
            forged = table[min(place, len(table) - 1)] | {"id": place + 1, "key": None}
            write(connection, [*table[:place], forged, *later])

        tamper(folder, put_in)
        found = verified(folder)
        # A copy in its original's place is in order; what comes after it is not.
        assert found.intact is False
        assert found.broken_id in (place + 1, place + 2)


@CHANGES
@given(entries=LISTS, data=st.data())
def test_a_chain_that_is_made_anew_is_not_the_one_that_was(
    empty: Path, entries: list[Entry], data: Any
) -> None:
    number = data.draw(st.integers(1, len(entries)))
    with kept(empty, entries) as (_, folder):

        def forge(connection: Cursor) -> None:
            table = read(connection)
            table[number - 1]["who"] += "!"
            write(connection, rechained(table))

        tamper(folder, forge)
        found = verified(folder)
        assert (found.intact, found.broken_id) == (False, len(entries))
        assert HEAD_FILE in found.detail


def test_what_was_removed_is_still_missed_after_more_was_entered(empty: Path) -> None:
    for later in range(1, 6):
        with kept(empty, some(4)) as (database, folder):
            tamper(folder, lambda c: c.execute("DELETE FROM audit WHERE id > 2"))
            do(database, *some(later))  # by the console that runs
            assert not verified(folder).intact
            again = Database(f"sqlite:///{folder / 'forcerig.sqlite'}")
            Audit(again, folder).follow()  # and by the one after it
            do(again, *some(later))
            assert not verified(folder).intact
            again.close()


def test_an_end_that_lags_after_a_kill_is_said_and_brought_up_to_date(empty: Path) -> None:
    with kept(empty, some(2)) as (_, folder):
        head = (folder / HEAD_FILE).read_bytes()
        unwatched = Database(f"sqlite:///{folder / 'forcerig.sqlite'}")
        do(unwatched, *some(3))
        found = verified(folder)
        assert (found.intact, found.behind, found.rows) == (True, 3, 5)
        assert (folder / HEAD_FILE).read_bytes() == head
        Audit(unwatched, folder).follow()
        do(unwatched, *some(1))
        assert verified(folder).behind == 0
        unwatched.close()


def test_an_end_that_is_gone_is_missed_for_ever(empty: Path) -> None:
    for damage in (Path.unlink, lambda path: path.write_text("{}")):
        with kept(empty, some(2)) as (_, folder):
            damage(folder / HEAD_FILE)
            assert verified(folder).broken_id == 3
            again = Database(f"sqlite:///{folder / 'forcerig.sqlite'}")
            Audit(again, folder).follow()
            do(again, *some(2))
            assert not verified(folder).intact
            again.close()


def test_an_audit_in_which_nothing_is_yet_is_intact(empty: Path) -> None:
    assert verified(empty).intact
    with kept(empty, []) as (_, folder):
        assert verified(folder).intact


STATEMENTS = {
    "sqlite": (
        "UPDATE audit SET why = 'x'",
        "DELETE FROM audit",
        "REPLACE INTO audit SELECT * FROM audit",
    ),
    "postgresql": ("UPDATE audit SET why = 'x'", "DELETE FROM audit", "TRUNCATE audit"),
}


def test_the_database_itself_refuses_to_change_a_row(database: Database) -> None:
    do(database, *some(2))
    before = rows(database)
    for statement in STATEMENTS[database.engine.dialect.name]:
        with pytest.raises(DBAPIError, match="only ever added to"), database.writing() as session:
            session.execute(text(statement))
    assert rows(database) == before
