"""What the requests about tests take and give."""

from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    StringConstraints,
    model_validator,
)

from app.db import NO_NUL
from app.definitions.blocks import Layer
from app.definitions.difference import ChangeKind
from app.definitions.outline import Outline
from app.definitions.preview import MOST_POINTS, Preview
from app.documents.tree import MAX_BYTES

LONGEST_ID = 100


def _each_once(tags: list[str]) -> list[str]:
    return sorted(set(tags))


TestId = Annotated[str, StringConstraints(pattern=r"^[a-z0-9][a-z0-9-]*$", max_length=LONGEST_ID)]
Tag = Annotated[
    str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, min_length=1, max_length=50)
]
Tags = Annotated[list[Tag], Field(max_length=50), AfterValidator(_each_once)]
Author = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=100)]
Comment = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=500)]
Yaml = Annotated[str, Field(max_length=MAX_BYTES, description="as written, with its comments")]
Number = Annotated[int, Field(ge=1, le=2**31 - 1)]


class _Asked(BaseModel):
    __test__ = False  # pytest would take what begins with Test for a test of ours
    model_config = ConfigDict(extra="forbid")


class TestText(_Asked):
    """A test as plain data or as YAML: exactly one of both.

    A bare definition (a mapping with `schema`) will do as well, as will YAML alone
    (`Content-Type: application/yaml`).
    """

    definition: dict[str, Any] | None = None
    yaml: Yaml | None = None

    @model_validator(mode="before")
    @classmethod
    def _bare(cls, data: Any) -> Any:
        if isinstance(data, bytes):
            return {"yaml": data.decode("utf-8")}
        return {"definition": data} if isinstance(data, dict) and "schema" in data else data

    @model_validator(mode="after")
    def _one_of_both(self) -> Self:
        if (self.definition is None) == (self.yaml is None):
            raise ValueError("exactly one of definition and yaml is needed")
        return self


class TestSave(TestText):
    """A test to be saved; without `tags` they stay as they are."""

    comment: Comment = ""
    author: Author = ""
    tags: Tags | None = None


class TestCreate(TestSave):
    """A new test; without an id it gets one from its name."""

    id: TestId | None = None


class TestEdit(TestSave):
    """A new revision, made from the one that `based_on` tells (or `If-Match`)."""

    based_on: Number | None = None


class TestClone(_Asked):
    """A copy, under another name."""

    name: Annotated[str, StringConstraints(min_length=1, max_length=200)] | None = None
    author: Author = ""


class TestTags(_Asked):
    """The tags of a test."""

    tags: Tags


class TestAuthor(_Asked):
    """Who does it, and why."""

    author: Author = ""
    comment: Comment = ""


class TestSummary(BaseModel):
    """A test in the list, by its newest revision."""

    __test__ = False

    id: str
    name: str
    description: str
    duration_s: float
    peak_force_n: float
    blocks: int
    revision: int
    tags: list[str]
    archived: bool
    updated_at: datetime
    author: str
    runs: int
    last_run_at: datetime | None


class TestDetail(TestSummary):
    """A revision of a test with its definition as data and as text, and what it comes to.

    `outline` is null where an old revision is no valid test any more.
    """

    definition: dict[str, Any]
    yaml: str
    outline: Outline | None
    comment: str
    created_at: datetime


class RevisionSummary(BaseModel):
    """A revision in the list."""

    number: int
    author: str
    comment: str
    created_at: datetime


class ChangeOut(BaseModel):
    """A key of the definition that two revisions differ in; what was removed as it was named before."""

    path: str
    before: Any
    after: Any
    kind: ChangeKind


class Difference(BaseModel):
    """What two revisions differ in; `text` is the unified difference of their YAML."""

    before: int = Field(serialization_alias="from")
    to: int
    changes: list[ChangeOut]
    text: str


class ProblemOut(BaseModel):
    """One thing wrong with a test; `line` counts from 1 where the text is known."""

    path: str
    value: Any
    message: str
    limit: float | None
    unit: str | None
    line: int | None


class PreviewAsk(TestText):
    """A window of a test that need not be saved; all of it where none is given."""

    from_s: Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)] = 0.0
    to_s: Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)] | None = None
    points: Annotated[int, Field(ge=1, le=MOST_POINTS)] = 1000


class PreviewOut(Preview):
    """The setpoints of a window, bin by bin, and what the whole test comes to."""

    outline: Outline


class SpectrumText(_Asked):
    """Rows of a spreadsheet, as they were pasted."""

    text: Annotated[str, Field(max_length=MAX_BYTES)]


class SpectrumOut(BaseModel):
    """The layers that could be read, and what is wrong with the lines that could not."""

    layers: list[Layer]
    problems: list[ProblemOut]


class TestChecked(BaseModel):
    """A test as data and as text, both as they were written, and what is wrong with it.

    `whole` is what would be saved: every default filled in. It is null where something is wrong.
    """

    __test__ = False

    valid: bool
    problems: list[ProblemOut]
    definition: dict[str, Any] | None = None
    whole: dict[str, Any] | None = None
    yaml: str | None = None
    outline: Outline | None = None


FileName = Annotated[str, StringConstraints(min_length=1, max_length=255)]


class TestFiles(_Asked):
    """Files to import, by their names."""

    files: Annotated[dict[FileName, str], Field(min_length=1, max_length=5000)]


class ImportedTest(BaseModel):
    """What became of a file."""

    name: str
    id: str
    action: Literal["created", "revised", "unchanged"]


class Imported(BaseModel):
    """What became of the files, in their order."""

    imported: list[ImportedTest]
