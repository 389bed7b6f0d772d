"""What the check of a table gives: faults as problem documents tell them."""

from pydantic import BaseModel

from app.interlocks.schemas import InterlocksDifference
from app.problems import FaultOut


class Weakened(BaseModel):
    """A guarded detector that a table falls short of, and how."""

    detector: str
    text: str


class InterlocksCheck(BaseModel):
    """Whether a table could be put in force, and what would change. Nothing was adopted."""

    valid: bool
    errors: list[FaultOut]
    weakened: list[Weakened]
    difference: InterlocksDifference | None
