"""Queries on the drills. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session, defer

from app.drills.models import UNDER_WAY, DrillGiven


def get(session: Session, number: int) -> DrillGiven | None:
    """A drill by its number."""
    return session.get(DrillGiven, number)


def to_change(session: Session, number: int) -> DrillGiven | None:
    """A drill that nobody else changes until the end of the transaction."""
    return session.get(DrillGiven, number, with_for_update=True)


def page(
    session: Session, fault: str | None, limit: int, before: int | None
) -> Sequence[DrillGiven]:
    """The newest drills, of one fault or of all, or those before a number; newest first."""
    query = select(DrillGiven).options(defer(DrillGiven.score)).order_by(DrillGiven.id.desc())
    if fault is not None:
        query = query.where(DrillGiven.fault == fault)
    if before is not None:
        query = query.where(DrillGiven.id < before)
    return session.scalars(query.limit(limit)).all()


def under_way(session: Session) -> Sequence[DrillGiven]:
    """Those that have no end."""
    return session.scalars(select(DrillGiven).where(DrillGiven.state == UNDER_WAY)).all()
