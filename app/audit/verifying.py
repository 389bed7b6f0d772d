"""Walking the chain from its first row: is every row as it was entered, and none gone?"""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from app.audit import repository
from app.audit.chain import START, Link, as_dict, hash_of
from app.audit.head import read_head
from app.audit.models import AuditRow
from app.audit.schemas import Verification
from app.db import Database


class Broken(NamedTuple):
    """The first row that is not as it should be, and what is wrong there."""

    id: int
    what: str


class _Walked(NamedTuple):
    end: Link
    at_head: str | None  # hash of the row that the head file knows as the last
    broken: Broken | None


def verify(database: Database, head_path: Path) -> Verification:
    """Look at every row. The file of the chain's end is read first: it may only lag."""
    head = read_head(head_path)
    with database.reading() as session:
        walked = _walk(repository.every(session), START.id if head is None else head.id)
        rows = repository.count(session)
    broken = walked.broken or _broken_end(head, head_path, walked)
    behind = 0 if head is None else max(0, walked.end.id - head.id)
    return Verification(
        rows=rows,
        intact=broken is None,
        broken_id=None if broken is None else broken.id,
        detail=_intact(rows, behind, head_path) if broken is None else broken.what,
        hash=walked.end.hash,
        behind=behind,
    )


def _walk(rows: Iterable[AuditRow], head_id: int) -> _Walked:
    end, at_head = START, START.hash if head_id == START.id else None
    for row in rows:
        what = _fault(row, end)
        if what is not None:
            number = min(row.id, end.id + 1)
            return _Walked(end, at_head, Broken(number, what))
        end = Link(row.id, row.hash)
        if row.id == head_id:
            at_head = row.hash
    return _Walked(end, at_head, None)


def _fault(row: AuditRow, before: Link) -> str | None:
    if row.id <= before.id:
        return f"Row {row.id} does not belong before row {before.id + 1}: it was put in"
    if row.id != before.id + 1:
        return f"Row {before.id + 1} is missing: row {row.id} comes after row {before.id}"
    if row.previous_hash != before.hash:
        return f"Row {row.id} does not follow from the row before it: one of them was exchanged"
    if row.hash != hash_of(as_dict(row)):
        return f"Row {row.id} is not as it was entered: it was changed afterwards"
    return None


def _broken_end(head: Link | None, path: Path, walked: _Walked) -> Broken | None:
    """What the file of the chain's end contradicts."""
    end = walked.end
    if head is None:
        if end == START and not path.exists():
            return None
        what = (
            f"{path.name} is missing or damaged: nothing tells whether rows were removed after row"
        )
        return Broken(end.id + 1, f"{what} {end.id}")
    if head.id > end.id:
        what = f"Row {end.id + 1} is missing: {path.name} knows of {head.id} rows"
        return Broken(end.id + 1, what)
    if walked.at_head != head.hash:
        what = (
            f"Row {head.id} is not the one that {path.name} knows: the rows up to it were made anew"
        )
        return Broken(head.id, what)
    return None


def _intact(rows: int, behind: int, path: Path) -> str:
    lag = f"; {path.name} lags by the newest {behind}: the next row brings it up to date"
    return f"{rows:,} rows, each as it was entered and none missing{lag if behind else ''}"
