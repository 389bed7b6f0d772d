"""`/api/v1/analysis`: static characteristic, loop and compensator, of what is in force or of a revision."""

from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import Field

from app.access.dependencies import Viewer
from app.controller.settings import ControllerSettings
from app.dependencies import ControllerService, RigConfigurationService
from app.errors import Refusal
from app.problems import PROBLEMS, granted
from app.revisions.schemas import Number
from app.sheets.asked import CompensatorAsked, LinearAsked, StaticAsked
from app.sheets.compensator import compensator_sheet
from app.sheets.linear import linear_sheet
from app.sheets.schemas import CompensatorSheet, LinearSheet, StaticSheet
from app.sheets.static import static_sheet
from rtcore.rig.parameters import RigParameters

router = APIRouter(prefix="/api/v1/analysis", tags=["analysis"], responses=PROBLEMS)

_RIG = Field(default=None, description="a revision of the rig configuration; without it, in force")
_CONTROLLER = Field(default=None, description="a revision of the controller; without it, in force")


class StaticQuery(StaticAsked):
    """With the revision of the rig configuration."""

    rig_revision: Number | None = _RIG


class LinearQuery(LinearAsked):
    """With the revisions of rig configuration and controller."""

    rig_revision: Number | None = _RIG
    controller_revision: Number | None = _CONTROLLER


class CompensatorQuery(CompensatorAsked):
    """With the revisions of rig configuration and controller."""

    rig_revision: Number | None = _RIG
    controller_revision: Number | None = _CONTROLLER


@router.get("/static", operation_id="analyseStatic")
def analyse_static(
    who: Viewer, asked: Annotated[StaticQuery, Query()], configurations: RigConfigurationService
) -> StaticSheet:
    """Static characteristic and force gain for bypass orifices (figure 5)."""
    rig = granted(_rig(configurations, asked.rig_revision))
    return static_sheet(rig, asked)


@router.get("/linear", operation_id="analyseLinear")
def analyse_linear(
    who: Viewer,
    asked: Annotated[LinearQuery, Query()],
    configurations: RigConfigurationService,
    controllers: ControllerService,
) -> LinearSheet:
    """K_1, K_2, τ, margins, open and closed loop at every amplitude."""
    rig = granted(_rig(configurations, asked.rig_revision))
    controller = granted(_controller(controllers, asked.controller_revision))
    return granted(linear_sheet(rig, controller, asked))


@router.get("/compensator", operation_id="analyseCompensator")
def analyse_compensator(
    who: Viewer,
    asked: Annotated[CompensatorQuery, Query()],
    configurations: RigConfigurationService,
    controllers: ControllerService,
) -> CompensatorSheet:
    """Each filter of the compensation, the loop with it and without, and its exact tuning (figure 11)."""
    rig = granted(_rig(configurations, asked.rig_revision))
    controller = granted(_controller(controllers, asked.controller_revision))
    return granted(compensator_sheet(rig, controller, asked))


def _rig(configurations: RigConfigurationService, number: int | None) -> RigParameters | Refusal:
    found = configurations.in_force if number is None else configurations.revision(number)
    return found if isinstance(found, Refusal) else found.document.model


def _controller(controllers: ControllerService, number: int | None) -> ControllerSettings | Refusal:
    found = controllers.in_force if number is None else controllers.revision(number)
    return found if isinstance(found, Refusal) else found.document
