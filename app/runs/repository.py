"""Queries on the runs. Each takes the session of the one transaction that it is part of."""

from collections.abc import Iterable, Sequence

from sqlalchemy import insert, select, update
from sqlalchemy.dialects.sqlite import insert as sqlite_insert
from sqlalchemy.orm import Session

from app.runs.models import Run, RunEvent


def get(session: Session, run_id: int) -> Run | None:
    """A run by its number."""
    return session.get(Run, run_id)


def page(session: Session, limit: int, before: int | None) -> Sequence[Run]:
    """The newest runs, or those before a number; newest first."""
    query = select(Run).order_by(Run.id.desc()).limit(limit)
    return session.scalars(query if before is None else query.where(Run.id < before)).all()


def without_outcome(session: Session) -> Sequence[Run]:
    """The runs that nobody has written the end of, oldest first."""
    return session.scalars(select(Run).where(Run.outcome.is_(None)).order_by(Run.id)).all()


def set_first_tick(session: Session, run_id: int, first_tick: int) -> None:
    """Note a run's first tick, unless it is known."""
    query = update(Run).where(Run.id == run_id, Run.first_tick.is_(None))
    session.execute(query.values(first_tick=first_tick))


def events(session: Session, run_id: int) -> Sequence[RunEvent]:
    """What the loop reported during a run, in order."""
    query = select(RunEvent).where(RunEvent.run_id == run_id)
    return session.scalars(query.order_by(RunEvent.tick, RunEvent.sequence)).all()


def add_events(session: Session, rows: Iterable[dict[str, object]]) -> None:
    """Add events. One whose run and sequence are there already stays as it is."""
    values = list(rows)
    if session.get_bind().dialect.name == "sqlite":
        session.execute(sqlite_insert(RunEvent).on_conflict_do_nothing(), values)
        return
    for row in values:
        key = (row["run_id"], row["sequence"])
        if session.get(RunEvent, key) is None:
            session.execute(insert(RunEvent), [row])
