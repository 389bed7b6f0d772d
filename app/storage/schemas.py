"""What the requests about storage take and give."""

from datetime import datetime
from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Tag = Annotated[str, Field(min_length=1, max_length=50)]


class StorageWord(StrEnum):
    """Whether there is room."""

    OK = "ok"
    LOW = "low"  # for less than an hour
    FULL = "full"  # no run can be recorded


class StorageState(BaseModel):
    """What is always on the screen; `seconds_left` of recording, null where nothing limits it."""

    free_bytes: int
    state: StorageWord
    seconds_left: float | None


class RetentionChange(BaseModel):
    """A new rule; `based_on` is the revision that it was made from, `apply` does it at once."""

    model_config = ConfigDict(extra="forbid")

    keep_days: Annotated[float, Field(gt=0, le=36_500, allow_inf_nan=False)] | None
    keep_bytes: Annotated[int, Field(ge=0, le=2**53)] | None
    keep_tags: Annotated[list[Tag], Field(max_length=100)]
    based_on: Annotated[int, Field(ge=0)]
    apply: bool = False


class RetentionOut(BaseModel):
    """The rule in force; null for no limit. A run with one of `keep_tags` keeps its samples."""

    revision: int
    keep_days: float | None
    keep_bytes: int | None
    keep_tags: list[str]
    applied_at: datetime | None


class Leaving(BaseModel):
    """A run whose samples go, and why."""

    id: int
    test_name: str
    ended_at: datetime | None
    bytes: int
    reason: str


class RetentionPreview(BaseModel):
    """What the rule removes now. The runs stay in the book, without their samples."""

    runs: list[Leaving]
    bytes: int


class StorageOut(BaseModel):
    """The disk, and what of it is used and left."""

    free_bytes: int
    total_bytes: int
    used_by_runs_bytes: int
    bytes_per_s: float
    reserve_bytes: int
    state: StorageWord
    seconds_left: float | None
    retention: RetentionOut
