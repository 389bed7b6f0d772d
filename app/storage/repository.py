"""Queries on what is kept. Each takes the session of the one transaction that it is part of."""

from collections.abc import Sequence
from datetime import datetime

from sqlalchemy import select, update
from sqlalchemy.orm import Session

from app.runs.models import Run, RunTag
from app.storage.models import ONLY, Retention


def retention(session: Session) -> Retention:
    """The rule; one that keeps everything where none has been given."""
    found = session.get(Retention, ONLY)
    if found is None:
        found = Retention(id=ONLY, revision=0, keep_tags=[])
        session.add(found)
    return found


def with_samples(session: Session) -> Sequence[Run]:
    """The runs that are over and have their samples, oldest first."""
    query = select(Run).where(Run.outcome.is_not(None), Run.samples_removed_at.is_(None))
    return session.scalars(query.where(Run.ticks > 0).order_by(Run.id)).all()


def tagged(session: Session, tags: Sequence[str]) -> set[int]:
    """The runs that have one of these tags."""
    return set(session.scalars(select(RunTag.run_id).where(RunTag.tag.in_(tags))).all())


def mark_removed(session: Session, run_ids: Sequence[int], at: datetime) -> None:
    """Note that the samples of these runs are removed."""
    for start in range(0, len(run_ids), 500):
        some = run_ids[start : start + 500]
        session.execute(update(Run).where(Run.id.in_(some)).values(samples_removed_at=at))


def removed(session: Session) -> Sequence[int]:
    """The runs whose samples are removed."""
    return session.scalars(select(Run.id).where(Run.samples_removed_at.is_not(None))).all()


def last_long_run(session: Session, ticks: int) -> Run | None:
    """The latest run that is over, has its samples and at least so many ticks."""
    query = select(Run).where(Run.outcome.is_not(None), Run.samples_removed_at.is_(None))
    return session.scalars(query.where(Run.ticks >= ticks).order_by(Run.id.desc()).limit(1)).first()
