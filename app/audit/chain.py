"""The chain: each row holds the hash of the one before, and is hashed with it."""

from collections.abc import Iterable, Iterator
from dataclasses import asdict
from typing import Any, NamedTuple

from app.audit.entry import Act
from app.audit.models import AuditRow
from app.documents.canonical import fingerprint
from app.runs.words import words_of


class Link(NamedTuple):
    """A row's place in the chain: its number, which is how many rows there are up to it, its hash."""

    id: int
    hash: str


START = Link(0, "")


def rows_after(newest: Link, acts: Iterable[Act]) -> Iterator[dict[str, Any]]:
    """The rows of some acts, chained on."""
    for act in acts:
        row = asdict(act) | {"id": newest.id + 1, "previous_hash": newest.hash}
        row["words"] = searched(row)
        row["hash"] = hash_of(row)
        newest = Link(row["id"], row["hash"])
        yield row


def hash_of(row: dict[str, Any]) -> str:
    """SHA-256 of everything in a row but its hash; the hash of the row before is in it."""
    return fingerprint({**row, "hash": None})


def searched(row: dict[str, Any]) -> str:
    """The words by which a row is found, each with a space before it."""
    texts = [row[name] or "" for name in ("who", "action", "target", "why", "outcome")]
    return "".join(f" {word}" for word in words_of(texts))


def as_dict(row: AuditRow) -> dict[str, Any]:
    """A row as it was made."""
    return {column.key: getattr(row, column.key) for column in AuditRow.__table__.columns}
