"""What the requests about interlocks take and give."""

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from app.definitions.difference import ChangeKind
from app.interlocks.detector import Detector
from app.revisions.schemas import Reason, SettingsRevision


class InterlocksText(BaseModel):
    """A table as plain data; `knowingly_weaker` names the guarded detectors that it falls short of."""

    model_config = ConfigDict(extra="forbid")

    detectors: Annotated[list[dict[str, Any]], Field(max_length=1000)]
    knowingly_weaker: Annotated[list[str], Field(max_length=1000)] = []


class InterlocksChange(InterlocksText, Reason):
    """Another table; `based_on` is the revision that it was made from."""


class TableRevision(SettingsRevision):
    """A table that was once in force: by whom, when and why."""


class RevisionOut(TableRevision):
    """With its table. Number 0 is the one as shipped."""

    detectors: tuple[Detector, ...]
    knowingly_weaker: tuple[str, ...]


class InterlocksOut(BaseModel):
    """The table in force. `in_loop` is whether the loop watches with it, `guarded` what it may not lack unsaid."""

    revision: int
    author: str
    why: str
    created_at: datetime
    in_loop: bool
    detectors: tuple[Detector, ...]
    knowingly_weaker: tuple[str, ...]
    guarded: tuple[str, ...]


class DetectorChangeOut(BaseModel):
    """What became of a detector, a line for each thing that is other."""

    detector: str
    kind: ChangeKind
    lines: tuple[str, ...]


class InterlocksDifference(BaseModel):
    """What two revisions differ in; null for one that is not stored."""

    before: int | None
    to: int | None
    detectors: list[DetectorChangeOut]
    reordered: bool


class DetectorState(StrEnum):
    """What a detector is doing."""

    OFF = "off"
    NOT_ARMED = "not_armed"  # in this mode
    CONTENT = "content"
    COUNTING = "counting"  # beyond its limit, not yet for long enough
    TRIPPED = "tripped"  # until it is reset, or content where it does not latch


class LiveDetector(BaseModel):
    """What a detector sees: the value that it judges, how far that is from its limit, and since when it is beyond.

    Null is what is no number; `text` and `limit` say it with units as operators read them.
    """

    name: str
    value: float | None
    text: str
    limit: str
    unit: str | None
    margin: float | None
    margin_share: float | None
    violated_s: float
    state: DetectorState
    first_out: bool
    trips: int


class LiveInterlocks(BaseModel):
    """All detectors at a tick, in the order of the table."""

    tick: int
    mode: str
    detectors: list[LiveDetector]
