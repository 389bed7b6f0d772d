"""Tests as the requests show them."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy.orm import Session

from app.catalogue import repository
from app.catalogue.models import Test, TestRevision
from app.catalogue.repository import Row, Use
from app.catalogue.schemas import TestDetail, TestSummary
from app.catalogue.written import Reader, Written
from app.definitions.outline import Outline
from app.runs.words import words_of


def summaries(
    session: Session,
    *,
    search: str,
    tag: str | None,
    archived: bool,
    after: str | None,
    limit: int,
) -> list[TestSummary]:
    """A page of the list, by ids."""
    sought = words_of([search])
    among = None if sought else limit
    rows = repository.newest(session, archived=archived, tag=tag, after=after, limit=among)
    if sought:
        tags = repository.tags_of(session, [row.test.id for row in rows])
        rows = [row for row in rows if _has(sought, row.test, tags.get(row.test.id, []))][:limit]
    ids = [row.test.id for row in rows]
    tags, uses = repository.tags_of(session, ids), repository.uses_of(session, ids)
    return [
        TestSummary(**_fields(row, tags.get(row.test.id, []), uses.get(row.test.id)))
        for row in rows
    ]


def _has(sought: Sequence[str], test: Test, tags: Sequence[str]) -> bool:
    words = words_of([test.id, test.name, test.description, *tags])
    return all(any(word.startswith(begin) for word in words) for begin in sought)


def detail(session: Session, reader: Reader, test: Test, revision: TestRevision) -> TestDetail:
    """A revision with all that it holds."""
    tags, uses = repository.tags_of(session, [test.id]), repository.uses_of(session, [test.id])
    fields = _fields(Row(test, revision), tags.get(test.id, []), uses.get(test.id))
    return TestDetail(
        **fields | _own(revision),
        definition=revision.definition,
        yaml=revision.yaml,
        outline=_outline(reader, revision),
        comment=revision.comment,
        created_at=revision.created_at,
    )


def _fields(row: Row, tags: Sequence[str], use: Use | None) -> dict[str, Any]:
    test, revision = row
    return {
        "id": test.id,
        "name": test.name,
        "description": test.description,
        "duration_s": revision.duration_s,
        "peak_force_n": revision.peak_force_n,
        "blocks": revision.block_count,
        "revision": revision.number,
        "tags": list(tags),
        "archived": test.archived_at is not None,
        "updated_at": test.updated_at,
        "author": revision.author,
        "runs": use.runs if use else 0,
        "last_run_at": use.last_run_at if use else None,
    }


def _own(revision: TestRevision) -> dict[str, Any]:
    """Name and description as they were in this revision."""
    names = ("name", "description")
    return {name: revision.definition.get(name, "") for name in names}


def _outline(reader: Reader, revision: TestRevision) -> Outline | None:
    written = reader.yaml(revision.yaml)
    return written.outline if isinstance(written, Written) else None
