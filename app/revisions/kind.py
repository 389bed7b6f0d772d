"""What is kept in revisions: a kind of document, a revision of it, and one that somebody wants in force."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Generic, Protocol, TypeVar

from pydantic import BaseModel
from sqlalchemy.orm import Session

from app.documents.writing import to_data
from app.errors import Refusal
from app.revisions.models import RevisionRow

D = TypeVar("D", bound=BaseModel)
Taken = TypeVar("Taken", bound=BaseModel, contravariant=True)


def _as_it_is(document: D) -> D:
    return document


@dataclass(frozen=True)
class Kind(Generic[D]):
    """A kind of document: what it is called, where it is kept, how it is read, and what may be in force.

    `adoptable` gives the document as it is to be adopted, or why it cannot be.
    """

    name: str  # as in `revision 3 of the interlocks`
    action: str  # in the audit
    row: type[RevisionRow]
    shipped: Callable[[], D]
    read: Callable[[Any, str], D | Refusal]
    adoptable: Callable[[D], D | Refusal] = _as_it_is
    verb: str = "have"  # that goes with the name

    def write(self, document: D) -> Mapping[str, Any]:
        """A document as it is stored."""
        return to_data(document)


@dataclass(frozen=True)
class Revision(Generic[D]):
    """A document that was adopted, by whom, when and why. Number 0 is the one as shipped."""

    number: int
    document: D
    author: str
    why: str
    created_at: datetime


@dataclass(frozen=True)
class Wanted(Generic[D]):
    """A document that somebody wants in force, on top of the revision that it was made from.

    `also` is written down in the very transaction of the revision, whose number it is told: both or neither.
    """

    document: D
    why: str
    based_on: int
    author: str
    lease: int | None = None
    also: Callable[[Session, int], None] | None = None


@dataclass(frozen=True)
class Preset(Generic[D]):
    """The document that a console is started with: as shipped, or of a file that is named here.

    `why` is what the very first revision says of itself where there is no file.
    """

    document: D
    file: str | None = None
    why: str = "As shipped"


class Loop(Protocol[Taken]):
    """What adopts a document."""

    def adopt(self, document: Taken, lease: int | None = None) -> Refusal | None:
        """Take a document over, whole or not at all; None where it did."""

    def has(self, document: Taken) -> bool:
        """Whether it works with this document."""

    def give_later(self) -> None:
        """Ask for the document in force as soon as that is safe."""
