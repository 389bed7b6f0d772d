"""Queries on runs that are compared."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import ColumnElement, Row, func, select
from sqlalchemy.orm import Session

from app.runs.models import Run, RunMeasurement


def values_over_runs(
    session: Session, test_id: str, measurement: str, block: int, limit: int
) -> Sequence[Row[Any]]:
    """The newest values of a measurement over the runs of a test, oldest first."""
    columns = (Run.id, Run.started_at, Run.revision, Run.outcome)
    limits = (RunMeasurement.value, RunMeasurement.at_least, RunMeasurement.at_most)
    query = select(*columns, *limits).join(RunMeasurement, RunMeasurement.run_id == Run.id)
    query = query.where(*_of(test_id, measurement, block)).order_by(Run.id.desc()).limit(limit)
    found: list[Row[Any]] = list(session.execute(query))
    return found[::-1]


def count_values(session: Session, test_id: str, measurement: str, block: int) -> int:
    """How many runs of a test have a value of a measurement."""
    query = select(func.count()).select_from(Run)
    query = query.join(RunMeasurement, RunMeasurement.run_id == Run.id)
    return session.scalar(query.where(*_of(test_id, measurement, block))) or 0


def _of(test_id: str, measurement: str, block: int) -> tuple[ColumnElement[bool], ...]:
    return (
        Run.test_id == test_id,
        RunMeasurement.name == measurement,
        RunMeasurement.block == block,
        RunMeasurement.value.is_not(None),
    )
