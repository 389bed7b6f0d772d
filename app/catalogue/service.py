"""The tests: found, saved as revisions that never change, archived, tagged, copied."""

from collections.abc import Sequence
from dataclasses import dataclass

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.catalogue import repository, shown
from app.catalogue.models import Test, TestRevision
from app.catalogue.refusals import archived as is_archived
from app.catalogue.refusals import conflict, exists, no_longer_valid, unknown, unknown_revision
from app.catalogue.saving import (
    Saved,
    add_revision,
    enter,
    is_unchanged,
    set_archived,
    set_tags,
)
from app.catalogue.schemas import RevisionSummary, TestAuthor, TestDetail, TestSummary
from app.catalogue.written import Reader, Written, slug
from app.db import Database
from app.definitions.definition import Definition
from app.errors import Code, Refusal

_ATTEMPTS = 20  # at each, one of those who want the same id gets it


@dataclass(frozen=True)
class StoredTest:
    """A revision of a test, ready to be run."""

    test_id: str
    revision: int
    name: str
    definition: Definition


class Catalogue:
    """The tests of this data directory."""

    def __init__(self, database: Database, reader: Reader) -> None:
        self._database = database
        self.reader = reader

    # ---- reading ----

    def list_tests(
        self,
        *,
        search: str = "",
        tag: str | None = None,
        archived: bool = False,
        after: str | None = None,
        limit: int = 1000,
    ) -> list[TestSummary]:
        """Tests by their ids; every word of `search` begins a word of what is shown."""
        with self._database.reading() as session:
            return shown.summaries(
                session, search=search, tag=tag, archived=archived, after=after, limit=limit
            )

    def get_test(self, test_id: str, number: int | None = None) -> TestDetail | Refusal:
        """A revision of a test, its newest by default."""
        with self._database.reading() as session:
            found = _find(session, test_id, number)
            return (
                found if isinstance(found, Refusal) else shown.detail(session, self.reader, *found)
            )

    def revisions(self, test_id: str) -> list[RevisionSummary] | Refusal:
        """The revisions of a test, the newest first."""
        with self._database.reading() as session:
            if repository.get(session, test_id) is None:
                return unknown(test_id)
            rows = repository.revisions(session, test_id)
            return [RevisionSummary.model_validate(row, from_attributes=True) for row in rows]

    def texts(self, test_id: str, number: int | None = None) -> TestRevision | Refusal:
        """A revision with its definition and its YAML."""
        with self._database.reading() as session:
            found = _find(session, test_id, number)
            return found if isinstance(found, Refusal) else found.revision

    def definition_of(self, test_id: str, revision: int | None = None) -> StoredTest | Refusal:
        """A revision to run, its newest by default, checked against what the rig can do now."""
        with self._database.reading() as session:
            found = _find(session, test_id, revision)
            if isinstance(found, Refusal):
                return found
            if found.test.archived_at is not None:
                return is_archived(test_id)
            written = self.reader.yaml(found.revision.yaml, test_id)
            if isinstance(written, Refusal):
                return no_longer_valid(found.revision, written)
            number = found.revision.number
            return StoredTest(test_id, number, written.definition.name, written.definition)

    # ---- writing ----

    def create(self, written: Written, saved: Saved, wanted: str | None = None) -> Test | Refusal:
        """Enter a new test, under the id that is wanted or one made from its name."""
        for _ in range(_ATTEMPTS):
            try:
                with self._database.writing() as session:
                    if wanted is not None and repository.get(session, wanted) is not None:
                        return exists(wanted)
                    test_id = wanted or repository.free_id(session, slug(written.definition.name))
                    return enter(session, test_id, written, saved)
            except IntegrityError:
                continue  # another console's request had it first
        return Refusal(Code.BUSY, "Others are saving tests of the same name: try again")

    def save(
        self, test_id: str, written: Written, saved: Saved, based_on: int | None
    ) -> Test | Refusal:
        """Save a new revision on top of the one that it was made from; nothing where none is new."""
        if based_on is None:
            return Refusal(
                Code.REVISION_NEEDED,
                "Which revision was this made from? Give its number as based_on, or in If-Match",
            )
        with self._database.writing() as session:
            test = repository.to_change(session, test_id)
            if test is None:
                return unknown(test_id)
            newest = repository.revision(session, test_id, test.revision)
            assert newest is not None
            unchanged = is_unchanged(newest, written)
            if based_on != test.revision and not unchanged:
                return conflict(test, newest, based_on)
            if not unchanged:
                add_revision(session, test, written, saved)
            if saved.tags is not None:
                set_tags(session, test_id, saved.tags)
            return test

    def restore_revision(self, test_id: str, number: int, by: TestAuthor) -> Test | Refusal:
        """Make an old revision the newest one, as a new revision."""
        with self._database.writing() as session:
            test = repository.to_change(session, test_id)
            old = _find(session, test_id, number)
            if test is None or isinstance(old, Refusal):
                return old if isinstance(old, Refusal) else unknown(test_id)
            written = self.reader.yaml(old.revision.yaml, test_id)
            if isinstance(written, Refusal):
                return no_longer_valid(old.revision, written)
            comment = by.comment or f"Revision {number} again"
            newest = repository.revision(session, test_id, test.revision)
            if newest is None or not is_unchanged(newest, written):
                add_revision(session, test, written, Saved(by.author, comment))
            return test

    def set_archived(self, test_id: str, archived: bool) -> Test | Refusal:
        """Put a test aside, or back. Its revisions and runs stay as they are."""
        with self._database.writing() as session:
            test = repository.to_change(session, test_id)
            if test is None:
                return unknown(test_id)
            set_archived(session, test, archived)
            return test

    def set_tags(self, test_id: str, tags: Sequence[str]) -> Test | Refusal:
        """Give a test these tags and no others."""
        with self._database.writing() as session:
            test = repository.to_change(session, test_id)
            if test is None:
                return unknown(test_id)
            set_tags(session, test_id, tags)
            return test

    def clone(self, test_id: str, name: str | None, author: str) -> Test | Refusal:
        """A copy of the newest revision, with the tags, under another name."""
        with self._database.reading() as session:
            found = _find(session, test_id, None)
            if isinstance(found, Refusal):
                return found
            written = self.reader.yaml(found.revision.yaml, test_id)
            if isinstance(written, Refusal):
                return no_longer_valid(found.revision, written)
            tags = repository.tags_of(session, [test_id]).get(test_id, [])
            origin = f"Copy of {test_id}, revision {found.revision.number}"
        copy = self.reader.renamed(written, name or f"{written.definition.name[:190]} (copy)")
        if isinstance(copy, Refusal):
            return copy
        return self.create(copy, Saved(author, origin, tags))


def _find(session: Session, test_id: str, number: int | None) -> repository.Row | Refusal:
    test = repository.get(session, test_id)
    if test is None:
        return unknown(test_id)
    found = repository.revision(session, test_id, number or test.revision)
    if found is None:
        return unknown_revision(test, number or test.revision)
    return repository.Row(test, found)
