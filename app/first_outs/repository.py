"""Queries on the first-outs. Each takes the session of the one transaction that it is part of."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import ColumnElement, func, select
from sqlalchemy.orm import Session, defer

from app.first_outs.models import FirstOut, KnownFirstOuts


@dataclass(frozen=True)
class Sought:
    """Which first-outs are asked for; what is None does not matter."""

    detector: str | None = None
    run_id: int | None = None
    since: datetime | None = None
    until: datetime | None = None  # and not then


def get(session: Session, number: int) -> FirstOut | None:
    """A first-out by its number."""
    return session.get(FirstOut, number)


def to_change(session: Session, number: int) -> FirstOut | None:
    """A first-out that nobody else changes until the end of the transaction."""
    return session.get(FirstOut, number, with_for_update=True)


def page(session: Session, sought: Sought, limit: int, before: int | None) -> Sequence[FirstOut]:
    """The newest of those that are sought, or those before a number; newest first."""
    query = select(FirstOut).options(defer(FirstOut.account)).order_by(FirstOut.id.desc())
    conditions: tuple[tuple[Any, Callable[[Any], ColumnElement[bool]]], ...] = (
        (sought.detector, lambda value: FirstOut.detector == value),
        (sought.run_id, lambda value: FirstOut.run_id == value),
        (sought.since, lambda value: FirstOut.tripped_at >= value),
        (sought.until, lambda value: FirstOut.tripped_at < value),
        (before, lambda value: FirstOut.id < value),
    )
    given = [condition(value) for value, condition in conditions if value is not None]
    return session.scalars(query.where(*given).limit(limit)).all()


def detectors(session: Session) -> list[str]:
    """Every detector that a first-out is of, in order."""
    query = select(FirstOut.detector).distinct().order_by(FirstOut.detector)
    return list(session.scalars(query))


def numbers(session: Session) -> set[int]:
    """The numbers of all first-outs."""
    return set(session.scalars(select(FirstOut.id)))


def is_known(session: Session, loop_life: str, tick: int) -> bool:
    """Whether a first-out has been entered, removed since or not."""
    known = session.get(KnownFirstOuts, loop_life)
    return known is not None and tick <= known.tick


def enter(session: Session, row: FirstOut) -> int:
    """Enter a first-out; its number."""
    session.add(row)
    session.merge(KnownFirstOuts(loop_life=row.loop_life, tick=row.tick))
    session.flush()
    return row.id


def beyond(session: Session, most: int) -> Sequence[FirstOut]:
    """The oldest without a note or cause, so many that no more than `most` are left."""
    total = session.scalar(select(func.count()).select_from(FirstOut)) or 0
    if total <= most:
        return []
    query = select(FirstOut).where(FirstOut.note == "", FirstOut.cause == "")
    return session.scalars(query.order_by(FirstOut.id).limit(total - most)).all()
