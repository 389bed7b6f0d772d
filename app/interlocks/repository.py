"""Queries on the revisions of the table. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session, undefer

from app.interlocks.models import InterlocksRevision


def newest(session: Session) -> InterlocksRevision | None:
    """The latest revision with its table, None where there is none yet."""
    query = select(InterlocksRevision).options(undefer(InterlocksRevision.document))
    return session.scalars(query.order_by(InterlocksRevision.number.desc()).limit(1)).first()


def revision(session: Session, number: int) -> InterlocksRevision | None:
    """A revision with its table."""
    options = [undefer(InterlocksRevision.document)]
    return session.get(InterlocksRevision, number, options=options)


def revisions(session: Session, before: int | None, limit: int) -> Sequence[InterlocksRevision]:
    """Revisions without their tables, the newest first; `before` is the last number of the page before."""
    query = select(InterlocksRevision).order_by(InterlocksRevision.number.desc()).limit(limit)
    if before is not None:
        query = query.where(InterlocksRevision.number < before)
    return session.scalars(query).all()
