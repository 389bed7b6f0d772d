"""Writing a test down: its row, and a revision that never changes afterwards.

What becomes of a test here is in the audit with it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from sqlalchemy.orm import Session

from app.audit.record import Entry, record
from app.catalogue import repository
from app.catalogue.differences import difference_of
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
        set_tags(session, test_id, saved.tags)
    return test


def add_revision(session: Session, test: Test, written: Written, saved: Saved) -> TestRevision:
    """Enter the next revision of a test."""
    before = repository.revision(session, test.id, test.revision) if test.revision else None
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
    record(session, _entry(before, revision))
    return revision


def set_tags(session: Session, test_id: str, tags: Sequence[str]) -> None:
    """Give a test these tags and no others."""
    before = repository.tags_of(session, [test_id]).get(test_id, [])
    repository.set_tags(session, test_id, tags)
    if before != sorted(tags):
        record(session, Entry("tests.tag", test_id, before=before, after=sorted(tags)))


def set_archived(session: Session, test: Test, archived: bool) -> None:
    """Put a test aside, or back."""
    if archived != (test.archived_at is not None):
        test.archived_at = datetime.now(UTC) if archived else None
        record(session, Entry("tests.archive" if archived else "tests.restore", test.id))


def _entry(before: TestRevision | None, after: TestRevision) -> Entry:
    saved: dict[str, object] = {"revision": after.number, "author": after.author}
    why = after.comment or None
    if before is None:
        return Entry("tests.create", after.test_id, why, after=saved | {"definition": after.yaml})
    difference = difference_of(before, after).text
    return Entry(
        "tests.save",
        after.test_id,
        why,
        before={"revision": before.number},
        after=saved | {"difference": difference},
    )


def is_unchanged(newest: TestRevision, written: Written) -> bool:
    """Whether there is nothing new: the same text, or the same data where it came as data."""
    if written.as_data:
        return newest.definition == written.data
    return newest.content_hash == written.content_hash
