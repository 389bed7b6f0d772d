"""Queries on the revisions of one kind. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence
from typing import TypeVar

from sqlalchemy import select
from sqlalchemy.orm import Session, undefer

from app.revisions.models import RevisionRow

R = TypeVar("R", bound=RevisionRow)


def newest(session: Session, row: type[R]) -> R | None:
    """The latest revision with its document, None where there is none yet."""
    query = select(row).options(undefer(row.document)).order_by(row.number.desc()).limit(1)
    return session.scalars(query).first()


def revision(session: Session, row: type[R], number: int) -> R | None:
    """A revision with its document."""
    return session.get(row, number, options=[undefer(row.document)])


def revisions(session: Session, row: type[R], before: int | None, limit: int) -> Sequence[R]:
    """Revisions without their documents, the newest first; `before` is the last number of the page before."""
    query = select(row).order_by(row.number.desc()).limit(limit)
    if before is not None:
        query = query.where(row.number < before)
    return session.scalars(query).all()
