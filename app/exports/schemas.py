"""What the requests about exports take and give."""

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.db import NO_NUL
from app.exports.extract import Wanted
from app.exports.formats import FormatName
from app.jobs.schemas import JobOut

Channel = Annotated[str, Field(pattern=NO_NUL, min_length=1, max_length=50)]
Seconds = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]


class ExportAsked(BaseModel):
    """All channels where none are named; times from the run's first tick, to its end without `to_s`."""

    model_config = ConfigDict(extra="forbid")

    format: FormatName
    channels: Annotated[list[Channel], Field(max_length=100)] = []
    from_s: Seconds = 0.0
    to_s: Seconds | None = None

    @property
    def wanted(self) -> Wanted:
        return Wanted(tuple(self.channels), self.from_s, self.to_s)


class ExportOut(JobOut):
    """An export and how far it is; its file is there from `done` until `kept_until`."""

    run_id: int
    format: FormatName
    channels: list[str]
    from_s: float
    to_s: float
    size_bytes: int | None
    kept_until: datetime | None
