"""What all requests about revisions take and give."""

from datetime import datetime
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from app.db import NO_NUL

Number = Annotated[int, Field(ge=0, le=2**31 - 1)]
Why = Annotated[
    str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, min_length=1, max_length=500)
]
Value = bool | int | float | str | None


class Reason(BaseModel):
    """Why something comes into force, on top of which revision; `lease` is the epoch of one's own."""

    model_config = ConfigDict(extra="forbid")

    why: Why
    based_on: Number
    lease: Annotated[int, Field(ge=0, le=2**53)] | None = None


class DocumentChange(Reason):
    """Another document; what it leaves out is as shipped."""

    document: Annotated[dict[str, Any], Field(max_length=100)]


class SettingsRevision(BaseModel):
    """A revision that was once in force: by whom, when and why."""

    number: int
    author: str
    why: str
    created_at: datetime


class SettingsChange(BaseModel):
    """A value that differs; null for one that is not there."""

    path: str
    unit: str | None
    before: Value
    after: Value


class SettingsDifference(BaseModel):
    """What two revisions differ in; null for one that is not stored."""

    before: int | None
    to: int | None
    changes: list[SettingsChange]
