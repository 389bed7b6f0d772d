"""`/api/v1/controller`: the gains and the compensator in force, those before them, and changing them."""

from typing import Annotated

from fastapi import APIRouter, Query

from app.access.dependencies import Engineer, Viewer
from app.controller import shown
from app.controller.record import controller_from
from app.controller.schemas import ControllerOut, ControllerRevisionOut
from app.dependencies import AuthorityService, ControllerService
from app.problems import PROBLEMS, granted
from app.revisions.difference import difference
from app.revisions.requests import Before, Limit, wanted
from app.revisions.schemas import (
    DocumentChange,
    Number,
    Reason,
    SettingsDifference,
    SettingsRevision,
)

router = APIRouter(prefix="/api/v1/controller", tags=["controller"], responses=PROBLEMS)


@router.get("", operation_id="getController")
def get_controller(who: Viewer, controllers: ControllerService) -> ControllerOut:
    """The settings in force, by whom, when and why, and whether the loop has them."""
    return shown.in_force(controllers.in_force, in_loop=controllers.loop_has_it())


@router.put("", operation_id="changeController")
def change_controller(
    who: Engineer, body: DocumentChange, controllers: ControllerService, authority: AuthorityService
) -> ControllerOut:
    """Put other settings in force, whole or not at all; refused while a test runs."""
    document = granted(controller_from(body.document, "body"))
    made = granted(controllers.change(wanted(who, body, document, authority)))
    return shown.in_force(made, in_loop=controllers.loop_has_it())


@router.get("/revisions", operation_id="listControllerRevisions")
def list_revisions(
    who: Viewer,
    controllers: ControllerService,
    before: Before = None,
    limit: Limit = 100,
) -> list[SettingsRevision]:
    """The revisions, the newest first."""
    rows = controllers.revisions(before, limit)
    return [SettingsRevision.model_validate(row, from_attributes=True) for row in rows]


@router.get("/revisions/{number}", operation_id="getControllerRevision")
def get_revision(
    who: Viewer, number: Number, controllers: ControllerService
) -> ControllerRevisionOut:
    """The settings as they were in force once; 0 are those as shipped."""
    return shown.revision(granted(controllers.revision(number)))


@router.post("/revisions/{number}/restore", operation_id="restoreControllerRevision")
def restore_revision(
    who: Engineer,
    number: Number,
    body: Reason,
    controllers: ControllerService,
    authority: AuthorityService,
) -> ControllerOut:
    """Put an earlier revision in force again, as a new one."""
    old = granted(controllers.revision(number))
    made = granted(controllers.change(wanted(who, body, old.document, authority)))
    return shown.in_force(made, in_loop=controllers.loop_has_it())


@router.get("/difference", operation_id="getControllerDifference")
def get_difference(
    who: Viewer,
    controllers: ControllerService,
    from_: Annotated[Number, Query(alias="from")],
    to: Number,
) -> SettingsDifference:
    """What two revisions differ in, value by value."""
    before, after = (granted(controllers.revision(number)) for number in (from_, to))
    return difference(before.document, after.document, (before.number, after.number))
