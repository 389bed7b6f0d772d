"""The table of the audit. Triggers refuse to change or remove a row."""

from sqlalchemy import Index, String, Text
from sqlalchemy.orm import Mapped, mapped_column

from app.audit.entry import LONGEST
from app.db import Base, BigInt, key_text


class AuditRow(Base):
    """An act, and the hashes that chain it to the one before. Ids count from 1 without gaps."""

    __tablename__ = "audit"
    __table_args__ = (
        Index("audit_at", "at"),
        Index("audit_who", "who", "id"),
        Index("audit_target", "target", "id"),
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True, autoincrement=False)
    at: Mapped[str] = mapped_column(
        key_text(32)
    )  # ISO 8601, UTC: when it was done, not when it was entered
    who: Mapped[str] = mapped_column(key_text(LONGEST))
    role: Mapped[str] = mapped_column(String(LONGEST))
    credential: Mapped[str] = mapped_column(String(LONGEST))
    action: Mapped[str] = mapped_column(key_text(LONGEST))
    target: Mapped[str] = mapped_column(key_text(LONGEST))
    why: Mapped[str | None] = mapped_column(Text)
    before: Mapped[str | None] = mapped_column(Text)  # JSON
    after: Mapped[str | None] = mapped_column(Text)
    outcome: Mapped[str] = mapped_column(String(LONGEST))
    key: Mapped[str | None] = mapped_column(String(50), unique=True)  # of an act from the spool
    previous_hash: Mapped[str] = mapped_column(String(64))
    hash: Mapped[str] = mapped_column(String(64))
    words: Mapped[str] = mapped_column(Text)  # by which it is found; made of the others
