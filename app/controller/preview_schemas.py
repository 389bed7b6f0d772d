"""What a preview of a controller takes and gives."""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from app.catalogue.schemas import LONGEST_ID
from app.jobs.schemas import JobOut
from app.revisions.schemas import Number


class PreviewAsked(BaseModel):
    """Settings that nobody has put in force, the test to try them with, and what they are laid beside."""

    model_config = ConfigDict(extra="forbid")

    document: Annotated[dict[str, Any], Field(max_length=100)]
    test_id: Annotated[str, Field(min_length=1, max_length=LONGEST_ID)] = "step-2-kn"
    beside: Number | None = Field(default=None, description="a revision; without it, in force")


class BlockMeasured(BaseModel):
    """A measurement of a block of the test."""

    block: int
    kind: str
    name: str
    unit: str
    value: float


class Stretches(BaseModel):
    """Least and greatest value over each stretch of time."""

    min: list[float]
    max: list[float]


class PreviewSide(BaseModel):
    """The test under one controller; `revision` is null for the draft.

    `nearest` is the detector that comes nearest to its trip, with what is left as a share of its limit.
    """

    revision: int | None
    outcome: str
    reason: str | None
    error_rms_n: float | None
    error_peak_n: float | None
    saturation_share: float
    nearest: str | None
    nearest_share: float | None
    measurements: list[BlockMeasured]
    time_s: list[float]
    force_n: Stretches
    force_command_n: Stretches


class Previewed(BaseModel):
    """Both, side by side."""

    test_id: str
    test_name: str
    draft: PreviewSide
    beside: PreviewSide


class ControllerPreview(JobOut):
    """A preview that is under way, or what came of it."""

    result: Previewed | None
