"""Queries on the tests. Each takes the session of the one transaction that it is part of."""

from collections.abc import Collection, Iterable, Sequence
from datetime import datetime
from typing import NamedTuple

from sqlalchemy import Select, delete, func, insert, select
from sqlalchemy.orm import Session, undefer

from app.catalogue.models import Test, TestRevision, TestTag
from app.runs.models import Run

_IN_ONE_QUERY = 500


class Row(NamedTuple):
    """A test with one of its revisions."""

    test: Test
    revision: TestRevision


class Use(NamedTuple):
    """How often a test was run, and when last."""

    runs: int
    last_run_at: datetime | None


def get(session: Session, test_id: str) -> Test | None:
    """A test by its id."""
    return session.get(Test, test_id)


def to_change(session: Session, test_id: str) -> Test | None:
    """A test that nobody else changes until the end of the transaction."""
    return session.get(Test, test_id, with_for_update=True)


def revision(session: Session, test_id: str, number: int) -> TestRevision | None:
    """A revision of a test, with all that it holds."""
    whole = [undefer(TestRevision.definition), undefer(TestRevision.yaml)]
    return session.get(TestRevision, (test_id, number), options=whole)


def revisions(session: Session, test_id: str) -> Sequence[TestRevision]:
    """The revisions of a test without what they hold, the newest first."""
    query = select(TestRevision).where(TestRevision.test_id == test_id)
    return session.scalars(query.order_by(TestRevision.number.desc())).all()


def newest(
    session: Session, *, archived: bool, tag: str | None, after: str | None, limit: int | None
) -> Sequence[Row]:
    """Tests with their newest revision, by their ids; `archived` adds the archived ones."""
    query = _with_newest()
    if not archived:
        query = query.where(Test.archived_at.is_(None))
    if tag is not None:
        query = query.where(Test.id.in_(select(TestTag.test_id).where(TestTag.tag == tag)))
    if after is not None:
        query = query.where(Test.id > after)
    return _rows(session, query.order_by(Test.id).limit(limit))


def newest_of(session: Session, ids: Collection[str]) -> Sequence[Row]:
    """These tests with all that their newest revisions hold, by their ids."""
    whole = [undefer(TestRevision.definition), undefer(TestRevision.yaml)]
    query = _with_newest().where(Test.id.in_(ids)).options(*whole)
    return _rows(session, query.order_by(Test.id))


def _rows(session: Session, query: Select[Test, TestRevision]) -> list[Row]:
    return [Row(row[0], row[1]) for row in session.execute(query)]


def _with_newest() -> Select[Test, TestRevision]:
    joined = (TestRevision.test_id == Test.id) & (TestRevision.number == Test.revision)
    return select(Test, TestRevision).join(TestRevision, joined)


def ids(session: Session) -> set[str]:
    """The ids of all tests, archived or not."""
    return set(session.scalars(select(Test.id)))


def tags_of(session: Session, ids: Sequence[str]) -> dict[str, list[str]]:
    """The tags of tests, in order."""
    found: dict[str, list[str]] = {}
    for some in _portions(ids):
        query = select(TestTag.test_id, TestTag.tag).where(TestTag.test_id.in_(some))
        for test_id, tag in session.execute(query):
            found.setdefault(test_id, []).append(tag)
    return {test_id: sorted(tags) for test_id, tags in found.items()}


def set_tags(session: Session, test_id: str, tags: Iterable[str]) -> None:
    """Give a test these tags and no others."""
    session.execute(delete(TestTag).where(TestTag.test_id == test_id))
    rows = [{"test_id": test_id, "tag": tag} for tag in tags]
    if rows:
        session.execute(insert(TestTag), rows)


def uses_of(session: Session, ids: Sequence[str]) -> dict[str, Use]:
    """How often tests were run."""
    found: dict[str, Use] = {}
    for some in _portions(ids):
        query = select(Run.test_id, func.count(), func.max(Run.started_at))
        rows = session.execute(query.where(Run.test_id.in_(some)).group_by(Run.test_id))
        found |= {test_id: Use(count, last) for test_id, count, last in rows}
    return found


def _portions(ids: Sequence[str]) -> Iterable[Sequence[str]]:
    """A database takes only so many values in one query."""
    return (ids[i : i + _IN_ONE_QUERY] for i in range(0, len(ids), _IN_ONE_QUERY))


def free_id(session: Session, wanted: str) -> str:
    """An id that nobody has: the one that is wanted, or with the next number behind it."""
    query = select(Test.id).where(Test.id.startswith(wanted, autoescape=True))
    taken = set(session.scalars(query))
    numbers = (f"{wanted}-{n}" for n in range(2, len(taken) + 3))
    return next(test_id for test_id in (wanted, *numbers) if test_id not in taken)
