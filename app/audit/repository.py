"""Queries on the audit. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence

from sqlalchemy import func, insert, select
from sqlalchemy.orm import Session

from app.audit.chain import START, Link, rows_after
from app.audit.entry import Act
from app.audit.models import AuditRow

_LOCK = 0x61756469  # "audi": no other lock of the console has this number


def append(session: Session, acts: Sequence[Act]) -> list[Link]:
    """Chain acts on, after every other writer: what is read here is the end until the commit."""
    if session.get_bind().dialect.name == "postgresql":  # SQLite has one writer anyway
        session.execute(select(func.pg_advisory_xact_lock(_LOCK)))
    before = newest(session)
    rows = list(rows_after(before, acts))
    session.execute(insert(AuditRow), rows)
    return [before, *(Link(row["id"], row["hash"]) for row in rows)]


def newest(session: Session) -> Link:
    """The end of the chain."""
    query = select(AuditRow.id, AuditRow.hash).order_by(AuditRow.id.desc()).limit(1)
    found = session.execute(query).first()
    return START if found is None else Link(*found)
