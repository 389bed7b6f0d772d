"""`/api/v1/identifications`."""

from fastapi import APIRouter

from app.access.dependencies import Engineer, Viewer
from app.dependencies import IdentificationsService
from app.identification.requests import (
    AdoptRequest,
    FittableParameter,
    IdentificationOut,
    IdentificationRequest,
    IdentificationSummary,
)
from app.parameters import Before, Limit, Number
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/identifications", tags=["identifications"], responses=PROBLEMS)


@router.get("", operation_id="listIdentifications")
def list_identifications(
    who: Viewer,
    identifications: IdentificationsService,
    before: Before = None,
    limit: Limit = 50,
) -> list[IdentificationSummary]:
    """The identifications, the newest first, and how far each is."""
    return identifications.page(limit, before)


@router.get("/parameters", operation_id="listFittableParameters")
def list_parameters(
    who: Viewer, identifications: IdentificationsService
) -> list[FittableParameter]:
    """Every parameter that can be fitted, with its value in the model in force."""
    return identifications.parameters()


@router.post("", operation_id="startIdentification", status_code=202)
def start_identification(
    who: Engineer, body: IdentificationRequest, identifications: IdentificationsService
) -> IdentificationOut:
    """Fit the model in force to runs that are over, in a process of its own."""
    return granted(identifications.start(who, body))


@router.get("/{number}", operation_id="getIdentification")
def get_identification(
    who: Viewer, number: Number, identifications: IdentificationsService
) -> IdentificationOut:
    """One with its fitted values, their intervals and correlation, what remains, and G before and after."""
    return granted(identifications.detail(number))


@router.post("/{number}/cancel", operation_id="cancelIdentification")
def cancel_identification(
    who: Engineer, number: Number, identifications: IdentificationsService
) -> IdentificationOut:
    """Give one up; one that has ended stays as it is."""
    return granted(identifications.cancel(number))


@router.delete("/{number}", operation_id="removeIdentification", status_code=204)
def remove_identification(
    who: Engineer, number: Number, identifications: IdentificationsService
) -> None:
    """Forget one that has ended and was not adopted."""
    granted(identifications.remove(number))


@router.post("/{number}/adopt", operation_id="adoptIdentification")
def adopt_identification(
    who: Engineer, number: Number, body: AdoptRequest, identifications: IdentificationsService
) -> IdentificationOut:
    """Put the model in force, what was found in the place of what was: a revision of the rig configuration."""
    return granted(identifications.adopt(who, number, body))
