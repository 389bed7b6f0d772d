"""The index of a library file: which file is which test, and its tags."""

from typing import Annotated, Literal

from pydantic import Field

from app.catalogue.schemas import Tags, TestId
from app.documents.fields import Document
from app.documents.reading import read_text
from app.documents.writing import to_yaml
from app.errors import Code, Refusal

INDEX = "library.yaml"


class Entry(Document):
    """A test of the library."""

    file: Annotated[str, Field(min_length=1, max_length=255)]
    id: TestId
    tags: Tags = Field(default_factory=list)


class Index(Document):
    """The tests of a library file, in its order."""

    library: Literal[1] = 1
    tests: tuple[Entry, ...] = Field(default=(), max_length=5000)


def index_text(index: Index) -> str:
    """The index as YAML."""
    return to_yaml(index)


def read_index(text: str) -> Index | Refusal:
    """The index in a text."""
    return read_text(Index, text, Code.INVALID_TEST, INDEX)
