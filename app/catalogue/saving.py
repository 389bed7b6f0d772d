"""Writing a test down: its row, and a revision that never changes afterwards."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.catalogue import repository
from app.catalogue.models import Test, TestRevision
from app.catalogue.written import Written


@dataclass(frozen=True)
class Saved:
    """By whom, why, and with which tags; None: with those that are there."""

    author: str = ""
    comment: str = ""
    tags: Sequence[str] | None = None


def enter(session: Session, test_id: str, written: Written, saved: Saved) -> Test:
    """Enter a new test. Raises IntegrityError where the id is taken."""
    now = datetime.now(UTC)
    test = Test(id=test_id, revision=0, created_at=now, name="", description="", updated_at=now)
    session.add(test)
    add_revision(session, test, written, saved)
    if saved.tags:
        repository.set_tags(session, test_id, saved.tags)
    return test


def add_revision(session: Session, test: Test, written: Written, saved: Saved) -> TestRevision:
    """Enter the next revision of a test."""
    test.revision += 1
    test.name, test.description = written.definition.name, written.definition.description
    test.updated_at = datetime.now(UTC)
    session.flush()  # the test before what refers to it
    revision = TestRevision(
        test_id=test.id,
        number=test.revision,
        definition=written.data,
        yaml=written.yaml,
        content_hash=written.content_hash,
        author=saved.author,
        comment=saved.comment,
        created_at=test.updated_at,
        duration_s=written.outline.duration_s,
        peak_force_n=written.outline.peak_force_n,
        block_count=len(written.definition.blocks),
    )
    session.add(revision)
    session.flush()
    return revision


def is_unchanged(newest: TestRevision, written: Written) -> bool:
    """Whether there is nothing new: the same text, or the same data where it came as data."""
    if written.as_data:
        return newest.definition == written.data
    return newest.content_hash == written.content_hash
