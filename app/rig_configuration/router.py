"""`/api/v1/rig-configuration`: what is known of the rig, what was known before, and changing it."""

from typing import Annotated

from fastapi import APIRouter, Query

from app.access.dependencies import Engineer, Viewer
from app.dependencies import AuthorityService, RigConfigurationService
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
from app.rig_configuration import shown
from app.rig_configuration.record import configuration_from
from app.rig_configuration.schemas import RigConfigurationOut, RigConfigurationRevisionOut

router = APIRouter(
    prefix="/api/v1/rig-configuration", tags=["rig configuration"], responses=PROBLEMS
)


@router.get("", operation_id="getRigConfiguration")
def get_configuration(who: Viewer, configurations: RigConfigurationService) -> RigConfigurationOut:
    """The configuration in force, by whom, when and why, and whether the loop's twin is of its model."""
    return shown.in_force(configurations.in_force, in_loop=configurations.loop_has_it())


@router.put("", operation_id="changeRigConfiguration")
def change_configuration(
    who: Engineer,
    body: DocumentChange,
    configurations: RigConfigurationService,
    authority: AuthorityService,
) -> RigConfigurationOut:
    """Put another in force, whole or not at all; another model only while there is no pressure."""
    document = granted(configuration_from(body.document, "body"))
    made = granted(configurations.change(wanted(who, body, document, authority)))
    return shown.in_force(made, in_loop=configurations.loop_has_it())


@router.get("/revisions", operation_id="listRigConfigurationRevisions")
def list_revisions(
    who: Viewer,
    configurations: RigConfigurationService,
    before: Before = None,
    limit: Limit = 100,
) -> list[SettingsRevision]:
    """The revisions, the newest first."""
    rows = configurations.revisions(before, limit)
    return [SettingsRevision.model_validate(row, from_attributes=True) for row in rows]


@router.get("/revisions/{number}", operation_id="getRigConfigurationRevision")
def get_revision(
    who: Viewer, number: Number, configurations: RigConfigurationService
) -> RigConfigurationRevisionOut:
    """The configuration as it was in force once; 0 is the one as shipped."""
    return shown.revision(granted(configurations.revision(number)))


@router.post("/revisions/{number}/restore", operation_id="restoreRigConfigurationRevision")
def restore_revision(
    who: Engineer,
    number: Number,
    body: Reason,
    configurations: RigConfigurationService,
    authority: AuthorityService,
) -> RigConfigurationOut:
    """Put an earlier revision in force again, as a new one."""
    old = granted(configurations.revision(number))
    made = granted(configurations.change(wanted(who, body, old.document, authority)))
    return shown.in_force(made, in_loop=configurations.loop_has_it())


@router.get("/difference", operation_id="getRigConfigurationDifference")
def get_difference(
    who: Viewer,
    configurations: RigConfigurationService,
    from_: Annotated[Number, Query(alias="from")],
    to: Number,
) -> SettingsDifference:
    """What two revisions differ in, value by value."""
    before, after = (granted(configurations.revision(number)) for number in (from_, to))
    return difference(before.document, after.document, (before.number, after.number))
