"""Runs for the tests of what is kept of them."""

from datetime import UTC, datetime
from typing import Any

from sqlalchemy.orm import Session

from app.runs import repository
from app.runs.models import Run, RunTag

FROZEN = ("definition", "plan", "controller", "interlocks", "rig", "conditions")


def a_run(session: Session, *, tags: tuple[str, ...] = (), **values: Any) -> Run:
    """A run that is not in the session yet."""
    return Run(
        **{f"{name}_id": repository.freeze(session, {name: 1}) for name in FROZEN},
        **{
            "test_id": "t",
            "test_name": "T",
            "software_version": "0",
            "loop_life": "1-1",
            "period_ns": 250_000,
            "started_at": datetime.now(UTC),
            "tag_rows": [RunTag(tag=tag) for tag in tags],
            **values,
        },
    )
