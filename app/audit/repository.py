"""Queries on the audit. Each takes the session of the one transaction that it is part of."""

from collections.abc import Iterable, Sequence

from sqlalchemy import func, insert, select
from sqlalchemy.orm import Session

from app.audit.chain import START, Link, rows_after
from app.audit.entry import Act
from app.audit.models import AuditRow
from app.audit.sought import Sought

_LOCK = 0x61756469  # "audi": no other lock of the console has this number
_AT_A_TIME = 1000


def append(session: Session, acts: Sequence[Act]) -> list[Link]:
    """Chain acts on, after every other writer: what is read here is the end until the commit.

    Returns the end before, and the new rows. An act whose key is there already is not entered again.
    """
    if session.get_bind().dialect.name == "postgresql":  # SQLite has one writer anyway
        session.execute(select(func.pg_advisory_xact_lock(_LOCK)))
    before = newest(session)
    known = _known(session, [act.key for act in acts if act.key is not None])
    rows = list(rows_after(before, (act for act in acts if act.key not in known)))
    if rows:
        session.execute(insert(AuditRow), rows)
    return [before, *(Link(row["id"], row["hash"]) for row in rows)]


def newest(session: Session) -> Link:
    """The end of the chain."""
    query = select(AuditRow.id, AuditRow.hash).order_by(AuditRow.id.desc()).limit(1)
    found = session.execute(query).first()
    return START if found is None else Link(*found)


def _known(session: Session, keys: Sequence[str]) -> set[str | None]:
    if not keys:
        return set()
    return set(session.scalars(select(AuditRow.key).where(AuditRow.key.in_(keys))))


def link(session: Session, number: int) -> Link | None:
    """A row's place in the chain; None where there is no such row."""
    if number == START.id:
        return START
    found = session.scalar(select(AuditRow.hash).where(AuditRow.id == number))
    return None if found is None else Link(number, found)


def page(session: Session, sought: Sought, limit: int, before: int | None) -> Sequence[AuditRow]:
    """The newest rows among those that are sought, or those before a number."""
    query = select(AuditRow).where(*sought.conditions())
    if before is not None:
        query = query.where(AuditRow.id < before)
    return session.scalars(query.order_by(AuditRow.id.desc()).limit(limit)).all()


def every(session: Session) -> Iterable[AuditRow]:
    """All rows in order, however many: they are read as they are asked for."""
    query = select(AuditRow).order_by(AuditRow.id).execution_options(yield_per=_AT_A_TIME)
    return session.scalars(query)


def count(session: Session) -> int:
    """How many rows there are."""
    return session.scalar(select(func.count()).select_from(AuditRow)) or 0
