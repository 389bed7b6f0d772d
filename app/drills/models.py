"""The table of the drills that were given."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Double, Index, String
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, BigInt, UtcDateTime

UNDER_WAY, PASSED, FAILED, INTERRUPTED = "under_way", "passed", "failed", "interrupted"


class DrillGiven(Base):
    """A drill: what was given, when, by whom, and how it was scored."""

    __tablename__ = "drills"
    # The file of its samples has its number: a number is never given twice.
    __table_args__ = (
        Index("drills_by_fault", "fault", "id"),
        Index("drills_by_state", "state"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    fault: Mapped[str] = mapped_column(String(40))
    amount: Mapped[float] = mapped_column(Double)
    state: Mapped[str] = mapped_column(String(20))
    mode_before: Mapped[str] = mapped_column(String(20))
    given_by: Mapped[str] = mapped_column(String(200))
    given_at: Mapped[datetime] = mapped_column(UtcDateTime)
    ended_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    loop_life: Mapped[str] = mapped_column(String(50))
    period_ns: Mapped[int] = mapped_column(BigInt)
    tick: Mapped[int | None] = mapped_column(BigInt)  # in which the loop took it
    run_id: Mapped[int | None] = mapped_column(BigInt)
    first_out: Mapped[str | None] = mapped_column(String(60))
    reaction_ticks: Mapped[int | None] = mapped_column(BigInt)
    why: Mapped[str | None] = mapped_column(String(500))  # it was interrupted
    ticks: Mapped[int] = mapped_column(BigInt, default=0)  # of samples that were kept
    score: Mapped[dict[str, Any] | None] = mapped_column(JSON)  # an `app.drills.score.Score`
