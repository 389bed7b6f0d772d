"""The table of the audit. Triggers refuse to change or remove a row."""

import json
from datetime import datetime
from typing import Any

from sqlalchemy import Dialect, Index, String, Text, TypeDecorator
from sqlalchemy.orm import Mapped, mapped_column

from app.audit.entry import LONGEST
from app.db import Base, BigInt, UtcDateTime, key_text


class JsonText(TypeDecorator[Any]):
    """JSON to the letter: SQLite makes 1 of the number 1.0 in a column of JSON."""

    impl = Text
    cache_ok = True

    def process_bind_param(self, value: Any, dialect: Dialect) -> str | None:
        return None if value is None else json.dumps(value, allow_nan=False)

    def process_result_value(self, value: str | None, dialect: Dialect) -> Any:
        return None if value is None else json.loads(value)


class AuditRow(Base):
    """An act, and the hashes that chain it to the one before. Ids count from 1 without gaps."""

    __tablename__ = "audit"
    __table_args__ = (
        Index("audit_at", "at"),
        Index("audit_who", "who", "id"),
        Index("audit_target", "target", "id"),
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True, autoincrement=False)
    at: Mapped[datetime] = mapped_column(UtcDateTime)  # when it was done, not when it was entered
    who: Mapped[str] = mapped_column(key_text(LONGEST))
    role: Mapped[str] = mapped_column(String(LONGEST))
    credential: Mapped[str] = mapped_column(String(LONGEST))
    action: Mapped[str] = mapped_column(key_text(LONGEST))
    target: Mapped[str] = mapped_column(key_text(LONGEST))
    why: Mapped[str | None] = mapped_column(Text)
    before: Mapped[Any] = mapped_column(JsonText)
    after: Mapped[Any] = mapped_column(JsonText)
    outcome: Mapped[str] = mapped_column(String(LONGEST))
    key: Mapped[str | None] = mapped_column(String(50), unique=True)  # of an act from the spool
    previous_hash: Mapped[str] = mapped_column(String(64))
    hash: Mapped[str] = mapped_column(String(64))
    words: Mapped[str] = mapped_column(Text)  # by which it is found; made of the others
