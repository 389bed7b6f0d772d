"""The tables of the runs."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, ForeignKey, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, UtcDateTime


class Run(Base):
    """A run and everything it was made with; none of that changes afterwards."""

    __tablename__ = "runs"
    # The loop and the files know a run by its number: a number is never given twice.
    __table_args__ = (
        Index("runs_open", "outcome", sqlite_where="outcome IS NULL"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(primary_key=True)
    test_id: Mapped[str] = mapped_column(String(100))
    test_name: Mapped[str] = mapped_column(String(200))
    definition: Mapped[dict[str, Any]] = mapped_column(JSON)
    plan: Mapped[dict[str, Any]] = mapped_column(JSON)  # blocks, cycles and durations expected
    controller: Mapped[dict[str, Any]] = mapped_column(JSON)
    interlocks: Mapped[dict[str, Any]] = mapped_column(JSON)
    rig: Mapped[dict[str, Any]] = mapped_column(JSON)
    conditions: Mapped[list[dict[str, Any]]] = mapped_column(JSON)  # real-time ones, had or not
    software_version: Mapped[str] = mapped_column(String(50))
    loop_life: Mapped[str] = mapped_column(String(50))
    period_ns: Mapped[int]
    started_at: Mapped[datetime] = mapped_column(UtcDateTime)
    ended_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    first_tick: Mapped[int | None]
    last_tick: Mapped[int | None]
    ticks: Mapped[int] = mapped_column(default=0)
    missing_ticks: Mapped[int] = mapped_column(default=0)
    outcome: Mapped[str | None] = mapped_column(String(20))  # None while it is under way
    verdict: Mapped[str] = mapped_column(String(10), default="unset")
    reason: Mapped[str | None] = mapped_column(String(500))


class RunEvent(Base):
    """What the loop reported during a run. `sequence` is the loop's own, negative for gaps."""

    __tablename__ = "run_events"

    run_id: Mapped[int] = mapped_column(ForeignKey("runs.id", ondelete="CASCADE"), primary_key=True)
    sequence: Mapped[int] = mapped_column(primary_key=True)
    tick: Mapped[int]
    kind: Mapped[str] = mapped_column(String(30))
    code: Mapped[str] = mapped_column(String(50))
    text: Mapped[str] = mapped_column(String(500))
    value: Mapped[float | None]  # None where it was not a number
    limit: Mapped[float | None]
