"""Queries on the identifications. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence

from sqlalchemy import select
from sqlalchemy.orm import Session

from app.identification.models import UNDER_WAY, Identification


def get(session: Session, number: int) -> Identification | None:
    """An identification by its number."""
    return session.get(Identification, number)


def to_change(session: Session, number: int) -> Identification | None:
    """One that nobody else changes until the end of the transaction."""
    return session.get(Identification, number, with_for_update=True)


def page(session: Session, limit: int, before: int | None) -> Sequence[Identification]:
    """The newest, or those before a number; newest first."""
    query = select(Identification).order_by(Identification.id.desc())
    if before is not None:
        query = query.where(Identification.id < before)
    return session.scalars(query.limit(limit)).all()


def under_way(session: Session) -> Sequence[Identification]:
    """Those that have no end."""
    return session.scalars(select(Identification).where(Identification.state.in_(UNDER_WAY))).all()
