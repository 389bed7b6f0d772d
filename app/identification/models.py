"""The table of the identifications."""

from datetime import datetime
from enum import StrEnum
from typing import Any

from sqlalchemy import JSON, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, BigInt, UtcDateTime


class State(StrEnum):
    """Where an identification is."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"
    INTERRUPTED = "interrupted"  # the console ended in the middle of it


UNDER_WAY = (State.WAITING, State.RUNNING)


class Identification(Base):
    """What was to be fitted to which runs, from which model on, and what came of it."""

    __tablename__ = "identifications"
    __table_args__ = (
        Index("identifications_by_state", "state"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    state: Mapped[str] = mapped_column(String(20))
    run_ids: Mapped[list[int]] = mapped_column(JSON)
    fit: Mapped[dict[str, Any]] = mapped_column(JSON)  # an `app.identification.schemas.Fit`
    based_on: Mapped[int]  # revision of the rig configuration
    model: Mapped[dict[str, Any]] = mapped_column(JSON)  # of that revision
    author: Mapped[str] = mapped_column(String(200))
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
    ended_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    reason: Mapped[str | None] = mapped_column(String(500))  # why nothing came of it
    result: Mapped[dict[str, Any] | None] = mapped_column(JSON)  # an `…schemas.Identified`
    adopted_revision: Mapped[int | None]
