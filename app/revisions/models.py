"""What every table of revisions is made of."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, String
from sqlalchemy.orm import Mapped, mapped_column

from app.db import UtcDateTime


class RevisionRow:
    """A document as it was once adopted; never changed afterwards. The newest is in force."""

    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    document: Mapped[dict[str, Any]] = mapped_column(JSON, deferred=True)
    author: Mapped[str] = mapped_column(String(100))
    why: Mapped[str] = mapped_column(String(500))
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
