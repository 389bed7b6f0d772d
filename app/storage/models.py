"""The table of the rule of retention: one row."""

from datetime import datetime

from sqlalchemy import JSON, Double
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, BigInt, UtcDateTime

ONLY = 1  # the row


class Retention(Base):
    """How long samples are kept; None for no limit. `revision` counts its changes."""

    __tablename__ = "retention"

    id: Mapped[int] = mapped_column(primary_key=True, default=ONLY)
    revision: Mapped[int] = mapped_column(default=0)
    keep_days: Mapped[float | None] = mapped_column(Double)
    keep_bytes: Mapped[int | None] = mapped_column(BigInt)
    keep_tags: Mapped[list[str]] = mapped_column(JSON, default=list)
    applied_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
