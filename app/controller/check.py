"""A draft looked at before it is in force: faults, differences, its loop and its compensator."""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from app.controller.settings import ControllerSettings
from app.errors import Refusal
from app.problems import FaultOut
from app.revisions.difference import difference
from app.revisions.kind import Revision
from app.revisions.schemas import SettingsDifference
from app.sheets.asked import CompensatorAsked, LinearAsked
from app.sheets.compensator import compensator_sheet
from app.sheets.linear import linear_sheet
from app.sheets.schemas import CompensatorSheet, LinearSheet
from rtcore.rig.parameters import RigParameters


class DraftAsked(BaseModel):
    """A draft, and for which loads to analyse it; `loop` or `compensator` null leaves that out."""

    model_config = ConfigDict(extra="forbid")

    document: Annotated[dict[str, Any], Field(max_length=100)]
    loop: LinearAsked | None = LinearAsked()
    compensator: CompensatorAsked | None = CompensatorAsked()


class ControllerCheck(BaseModel):
    """Whether a draft could be put in force, and what would be other. Nothing was adopted."""

    valid: bool
    errors: list[FaultOut]
    difference: SettingsDifference | None
    loop: LinearSheet | None
    compensator: CompensatorSheet | None


def checked(
    draft: ControllerSettings | Refusal,
    asked: DraftAsked,
    now: Revision[ControllerSettings],
    rig: RigParameters,
) -> ControllerCheck | Refusal:
    """What is to be said of a draft on top of this revision."""
    if isinstance(draft, Refusal):
        errors = [FaultOut.of(fault) for fault in draft.faults]
        return ControllerCheck(
            valid=False, errors=errors, difference=None, loop=None, compensator=None
        )
    loop = None if asked.loop is None else linear_sheet(rig, draft, asked.loop)
    if isinstance(loop, Refusal):
        return loop
    branch = None if asked.compensator is None else compensator_sheet(rig, draft, asked.compensator)
    if isinstance(branch, Refusal):
        return branch
    changes = difference(now.document, draft, (now.number, None))
    return ControllerCheck(valid=True, errors=[], difference=changes, loop=loop, compensator=branch)
