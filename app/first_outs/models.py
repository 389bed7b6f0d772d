"""The tables of the first-outs."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Double, Index, String, Text, UniqueConstraint
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, BigInt, UtcDateTime


class FirstOut(Base):
    """A detector that took the load off. Only what people note of it changes afterwards."""

    __tablename__ = "first_outs"
    # Files and people know it by its number: a number is never given twice.
    __table_args__ = (
        UniqueConstraint("loop_life", "tick"),
        Index("first_outs_by_detector", "detector", "id"),
        Index("first_outs_by_run", "run_id", "id"),
        Index("first_outs_by_time", "tripped_at"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    loop_life: Mapped[str] = mapped_column(String(50))
    tick: Mapped[int] = mapped_column(BigInt)
    tripped_at: Mapped[datetime] = mapped_column(UtcDateTime)
    detector: Mapped[str] = mapped_column(String(60))
    quantity: Mapped[str] = mapped_column(String(40))
    action: Mapped[str] = mapped_column(String(20))
    text: Mapped[str] = mapped_column(String(500))
    value: Mapped[float | None] = mapped_column(Double)  # None where it was no number
    limit: Mapped[float | None] = mapped_column(Double)
    mode_before: Mapped[str | None] = mapped_column(String(20))
    run_id: Mapped[int | None] = mapped_column(BigInt)
    period_ns: Mapped[int] = mapped_column(BigInt)
    ticks: Mapped[int] = mapped_column(BigInt)  # in its black box
    account: Mapped[dict[str, Any]] = mapped_column(JSON)  # an `app.first_outs.account.Account`
    note: Mapped[str] = mapped_column(Text, default="")
    cause: Mapped[str] = mapped_column(String(200), default="")


class KnownFirstOuts(Base):
    """Up to which tick the first-outs of a life of the loop were entered, removed ones included."""

    __tablename__ = "first_outs_known"

    loop_life: Mapped[str] = mapped_column(String(50), primary_key=True)
    tick: Mapped[int] = mapped_column(BigInt)
