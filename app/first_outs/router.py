"""`/api/v1/first-outs`."""

from typing import Annotated

from fastapi import APIRouter, Query, Response
from fastapi.responses import FileResponse

from app.access.dependencies import Engineer, Operator, Viewer
from app.dependencies import FirstOutsService
from app.first_outs.repository import Sought
from app.first_outs.schemas import FirstOutDetail, FirstOutNote, FirstOutPage
from app.parameters import Apart, Before, Channels, Limit, Number, Points, names_in
from app.problems import PROBLEMS, granted
from app.runs.schemas import Moment, RunSamples

router = APIRouter(prefix="/api/v1/first-outs", tags=["first-outs"], responses=PROBLEMS)


@router.get("", operation_id="listFirstOuts")
def list_first_outs(
    who: Viewer,
    first_outs: FirstOutsService,
    detector: Annotated[str | None, Query(max_length=60)] = None,
    run: Annotated[int | None, Query(ge=1, le=2**53)] = None,
    since: Annotated[Moment | None, Query(alias="from")] = None,
    until: Annotated[Moment | None, Query(alias="to", description="and not then")] = None,
    limit: Limit = 50,
    before: Before = None,
) -> FirstOutPage:
    """The newest first-outs first; `next` of a page is `before` of the page after it."""
    return first_outs.page(Sought(detector, run, since, until), limit, before)


@router.get("/detectors", operation_id="listFirstOutDetectors")
def list_first_out_detectors(who: Viewer, first_outs: FirstOutsService) -> list[str]:
    """Every detector that a first-out is of, in order."""
    return first_outs.detectors()


@router.get("/{number}", operation_id="getFirstOut")
def get_first_out(who: Viewer, number: Number, first_outs: FirstOutsService) -> FirstOutDetail:
    """A first-out with what the loop reported around it and what was in force."""
    return granted(first_outs.detail(number))


@router.get("/{number}/samples", operation_id="getFirstOutSamples", response_model=RunSamples)
def get_first_out_samples(
    who: Viewer,
    number: Number,
    first_outs: FirstOutsService,
    channels: Channels,
    from_s: Annotated[Apart, Query(description="from the first-out: negative before it")] = -10.0,
    to_s: Apart | None = None,
    points: Points = 2000,
) -> Response:
    """Least and greatest value in each of at most `points` stretches; times count from the first-out."""
    names = names_in(channels)
    found = granted(first_outs.window(number, names, from_s, to_s, points))
    return Response(found.model_dump_json(), media_type="application/json")


class _Parquet(FileResponse):
    media_type = "application/vnd.apache.parquet"


@router.get("/{number}/data.parquet", operation_id="getFirstOutParquet", response_class=_Parquet)
def get_first_out_parquet(
    who: Viewer, number: Number, first_outs: FirstOutsService
) -> FileResponse:
    """Every tick and every channel, with what was in force in its metadata."""
    path = granted(first_outs.parquet(number))
    name = f"forcerig-first-out-{number}.parquet"
    return _Parquet(path, media_type=_Parquet.media_type, filename=name)


@router.patch("/{number}", operation_id="annotateFirstOut")
def annotate_first_out(
    who: Operator, number: Number, body: FirstOutNote, first_outs: FirstOutsService
) -> FirstOutDetail:
    """Note what was found out, and the cause."""
    return granted(first_outs.annotate(number, body))


@router.delete("/{number}", operation_id="removeFirstOut", status_code=204)
def remove_first_out(who: Engineer, number: Number, first_outs: FirstOutsService) -> None:
    """Remove a first-out with its samples; the audit keeps that it was there."""
    granted(first_outs.remove(number))
