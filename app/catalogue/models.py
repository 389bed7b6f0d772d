"""The tables of the tests."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Double, ForeignKey, Index, String, Text
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base, UtcDateTime, key_text


class Test(Base):
    """A test as it is now; `name` and `description` are those of its newest revision."""

    __test__ = False  # pytest would take it for a test of ours
    __tablename__ = "tests"

    id: Mapped[str] = mapped_column(key_text(100), primary_key=True)
    name: Mapped[str] = mapped_column(String(200))
    description: Mapped[str] = mapped_column(Text)
    revision: Mapped[int]  # the newest
    archived_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
    updated_at: Mapped[datetime] = mapped_column(UtcDateTime)


class TestTag(Base):
    """A tag of a test."""

    __test__ = False
    __tablename__ = "test_tags"
    __table_args__ = (Index("test_tags_by_tag", "tag", "test_id"),)

    test_id: Mapped[str] = mapped_column(
        key_text(100), ForeignKey("tests.id", ondelete="CASCADE"), primary_key=True
    )
    tag: Mapped[str] = mapped_column(key_text(50), primary_key=True)


class TestRevision(Base):
    """A test as it was saved once; never changed afterwards.

    What the list shows of it is kept beside it, so that a list reads no definitions.
    """

    __test__ = False
    __tablename__ = "test_revisions"

    test_id: Mapped[str] = mapped_column(
        key_text(100), ForeignKey("tests.id", ondelete="CASCADE"), primary_key=True
    )
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    definition: Mapped[dict[str, Any]] = mapped_column(JSON, deferred=True)
    yaml: Mapped[str] = mapped_column(Text, deferred=True)  # as written, with its comments
    content_hash: Mapped[str] = mapped_column(String(64))  # of the YAML
    author: Mapped[str] = mapped_column(String(100), default="")
    comment: Mapped[str] = mapped_column(String(500), default="")
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
    duration_s: Mapped[float] = mapped_column(Double)
    peak_force_n: Mapped[float] = mapped_column(Double)
    block_count: Mapped[int]
