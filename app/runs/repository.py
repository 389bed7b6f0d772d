"""Queries on the runs. Each takes the session of the one transaction that it is part of."""

from collections.abc import Iterable, Sequence
from typing import Any

from sqlalchemy import delete, exists, func, insert, not_, or_, select, update
from sqlalchemy.dialects.postgresql import insert as postgresql_insert
from sqlalchemy.dialects.sqlite import insert as sqlite_insert
from sqlalchemy.orm import Session

from app.db import Base
from app.documents.canonical import fingerprint
from app.runs import finding
from app.runs.finding import Sought
from app.runs.models import Document, Run, RunCriterion, RunEvent, RunMeasurement, RunTag

_INSERT: dict[str, Any] = {"sqlite": sqlite_insert, "postgresql": postgresql_insert}


def get(session: Session, run_id: int) -> Run | None:
    """A run by its number."""
    return session.get(Run, run_id)


def to_change(session: Session, run_id: int) -> Run | None:
    """A run that nobody else changes until the end of the transaction."""
    return session.get(Run, run_id, with_for_update=True)


def page(session: Session, sought: Sought, limit: int, before: int | None) -> Sequence[Run]:
    """The newest runs among those that are sought, or those before a number; newest first."""
    found = finding.ids(session, sought, before, limit)
    return session.scalars(select(Run).where(Run.id.in_(found)).order_by(Run.id.desc())).all()


def tags(session: Session) -> list[str]:
    """Every tag that a run has, in order."""
    return finding.each(session, RunTag.tag)


def operators(session: Session) -> list[str]:
    """Everybody who is noted as the operator of a run, in order."""
    return [operator for operator in finding.each(session, Run.operator) if operator]


def by_outcome(session: Session) -> dict[str, int]:
    """How many runs ended how."""
    ended = select(Run.outcome, func.count()).where(Run.outcome.is_not(None)).group_by(Run.outcome)
    return {str(outcome): count for outcome, count in session.execute(ended)}


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
    _insert_new(session, RunEvent, list(rows))


def set_measured(
    session: Session,
    run_id: int,
    measurements: Sequence[dict[str, Any]],
    criteria: Sequence[dict[str, Any]],
) -> None:
    """Write down what was measured of a run and how it was judged, in place of what is there."""
    for table, rows in ((RunMeasurement, measurements), (RunCriterion, criteria)):
        session.execute(delete(table).where(table.run_id == run_id))
        if rows:
            session.execute(insert(table), rows)


def measurements(session: Session, run_id: int) -> Sequence[RunMeasurement]:
    """What was measured of a run, block by block; the run as a whole first."""
    query = select(RunMeasurement).where(RunMeasurement.run_id == run_id)
    return session.scalars(query.order_by(RunMeasurement.block)).all()


def criteria(session: Session, run_id: int) -> Sequence[RunCriterion]:
    """How a run was judged, in the order of its definition."""
    query = select(RunCriterion).where(RunCriterion.run_id == run_id)
    return session.scalars(query.order_by(RunCriterion.position)).all()


def freeze(session: Session, body: Any) -> int:
    """The number of a document with this content; it is entered where there is none yet."""
    key = fingerprint(body)
    query = select(Document.id).where(Document.hash == key)
    found = session.scalar(query)
    if found is None:
        _insert_new(session, Document, [{"hash": key, "body": body}])
        found = session.scalars(query).one()
    return found


def newest_document(session: Session) -> int:
    """The number of the newest document, 0 where there is none."""
    return session.scalar(select(func.max(Document.id))) or 0


def forget(session: Session, documents: Iterable[int]) -> None:
    """Remove documents, those that a run is made with excepted."""
    columns = [column for column in Run.__table__.c if column.foreign_keys]
    used = [exists().where(column == Document.id) for column in columns]
    query = delete(Document).where(Document.id.in_(list(documents)), not_(or_(*used)))
    session.execute(query)


def _insert_new(session: Session, table: type[Base], rows: list[dict[str, Any]]) -> None:
    """Insert rows; one whose key is there already stays as it is."""
    if rows:
        insert = _INSERT[session.get_bind().dialect.name]
        session.execute(insert(table).on_conflict_do_nothing(), rows)
