"""Entries for tests, and what is in the table."""

from typing import Any

from hypothesis import strategies as st
from sqlalchemy import text

from app.audit.record import Entry, record
from app.db import Database

TEXT = st.text(max_size=30)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | TEXT,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXT, inner, max_size=3),
    max_leaves=6,
)
ENTRIES = st.builds(
    Entry,
    action=st.sampled_from(["tests.save", "rig.stop", "tests.create"]) | TEXT,
    target=TEXT,
    why=st.none() | TEXT,
    before=JSON,
    after=JSON,
    refused=st.none() | st.just("wrong_mode"),
)


def do(database: Database, *entries: Entry) -> None:
    """Enter some, each in a transaction of its own."""
    for entry in entries:
        with database.writing() as session:
            record(session, entry)


def some(count: int, action: str = "tests.save") -> list[Entry]:
    """Entries that differ in their targets."""
    return [Entry(action, f"test-{n}", after={"n": n}) for n in range(count)]


def rows(database: Database) -> list[Any]:
    """The rows as they are in the table."""
    with database.reading() as session:
        return list(session.execute(text("SELECT * FROM audit ORDER BY id")).mappings())


def targets(database: Database) -> list[str]:
    """What was done to what, in order."""
    return [row["target"] for row in rows(database)]
