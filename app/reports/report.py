"""A report as data: words, tables and figures in their order, without a word of any format.

Whatever renders it decides what it looks like; whatever is in it is shown literally, never read as markup.
"""

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum


class Tone(StrEnum):
    """How much something matters: it is told by words and weight, and never by colour alone."""

    PLAIN = "plain"
    GOOD = "good"
    BAD = "bad"
    QUIET = "quiet"


@dataclass(frozen=True)
class Words:
    """A paragraph."""

    text: str
    tone: Tone = Tone.PLAIN
    kind: str = "words"


@dataclass(frozen=True)
class Facts:
    """Pairs of a name and a value."""

    pairs: tuple[tuple[str, str], ...]
    kind: str = "facts"


@dataclass(frozen=True)
class Column:
    """The head of a column; numbers stand on the right. `share` is its width beside the others', None as needed."""

    head: str
    number: bool = False
    share: float | None = None


@dataclass(frozen=True)
class Row:
    """As many cells as there are columns."""

    cells: tuple[str, ...]
    tone: Tone = Tone.PLAIN


@dataclass(frozen=True)
class Table:
    """A table with a caption; its head is repeated on each page that it goes on to."""

    caption: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    kind: str = "table"


@dataclass(frozen=True)
class Figure:
    """A vector figure (SVG) with a caption; `told` says in words what it shows."""

    caption: str
    svg: bytes
    told: str
    kind: str = "figure"


Item = Words | Facts | Table | Figure


@dataclass(frozen=True)
class Section:
    """A heading and what stands under it."""

    title: str
    items: tuple[Item, ...]
    own_page: bool = False


@dataclass(frozen=True)
class Verdict:
    """What it came to, in a word and a sentence."""

    word: str
    sentence: str
    tone: Tone


@dataclass(frozen=True)
class Report:
    """All of a report. `about` stands on the first page under the verdict, `label` on every page.

    `dated` is when what it tells of was over: None where no clock was near, as in a simulation.
    """

    title: str
    subtitle: str
    label: str
    verdict: Verdict
    about: tuple[Item, ...]
    sections: tuple[Section, ...]
    dated: datetime | None
    software: str
