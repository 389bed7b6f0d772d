"""`/api/v1/drills`."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from app.access.dependencies import Engineer, Viewer
from app.dependencies import DrillsService
from app.drills.schemas import (
    ClearRequest,
    DrillCatalogue,
    DrillDetail,
    DrillPage,
    DrillRequest,
)
from app.parameters import Apart, Before, Channels, Limit, Number, Points, names_in
from app.problems import PROBLEMS, granted
from app.runs.schemas import RunSamples

router = APIRouter(prefix="/api/v1/drills", tags=["drills"], responses=PROBLEMS)


@router.get("", operation_id="listDrills")
def list_drills(who: Viewer, drills: DrillsService) -> DrillCatalogue:
    """Every drill, what must follow it, and why it cannot be given now."""
    return drills.catalogue()


@router.post("", operation_id="giveDrill", status_code=201)
def give_drill(who: Engineer, body: DrillRequest, drills: DrillsService) -> DrillDetail:
    """Give the simulated rig a fault. The drill is under way; its record is scored when all has been seen."""
    return granted(drills.give(who, body))


@router.post("/clear", operation_id="clearDrills")
def clear_drills(who: Engineer, body: ClearRequest, drills: DrillsService) -> DrillCatalogue:
    """Take all faults back. A drill under way ends without a score."""
    return granted(drills.clear(who, body))


@router.get("/records", operation_id="listDrillRecords")
def list_drill_records(
    who: Viewer,
    drills: DrillsService,
    fault: Annotated[str | None, Query(max_length=40)] = None,
    limit: Limit = 50,
    before: Before = None,
) -> DrillPage:
    """The newest drills first; `next` of a page is `before` of the page after it."""
    return drills.page(fault, limit, before)


@router.get("/records/{number}", operation_id="getDrillRecord")
def get_drill_record(who: Viewer, number: Number, drills: DrillsService) -> DrillDetail:
    """A drill with what was expected and what was seen."""
    return granted(drills.detail(number))


@router.get("/records/{number}/samples", operation_id="getDrillSamples", response_model=RunSamples)
def get_drill_samples(
    who: Viewer,
    number: Number,
    drills: DrillsService,
    channels: Channels,
    from_s: Annotated[Apart, Query(description="from the fault: negative before it")] = -10.0,
    to_s: Apart | None = None,
    points: Points = 2000,
) -> Response:
    """Least and greatest value in each of at most `points` stretches; each tick where there are enough."""
    names = names_in(channels)
    found = granted(drills.window(number, names, from_s, to_s, points))
    return Response(found.model_dump_json(), media_type="application/json")
