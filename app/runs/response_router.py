"""`/api/v1/runs/{id}/frequency-response`."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from app.access.dependencies import Viewer
from app.dependencies import ResponsesService
from app.parameters import Number
from app.prediction.schemas import Computing
from app.problems import PROBLEMS, granted
from app.run_analysis.router import COMPUTING, WaitS
from app.runs.response_schemas import ResponseOut, TransferName

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)


@router.get(
    "/{run_id}/frequency-response", operation_id="getFrequencyResponse", responses=COMPUTING
)
def get_frequency_response(
    who: Viewer,
    run_id: Number,
    responses: ResponsesService,
    response: Response,
    transfer: Annotated[TransferName, Query(description="from which channel to which")] = "force",
    load_hz: Annotated[
        float | None,
        Query(gt=0, lt=2000, description="of the open loop: under a load of this frequency"),
    ] = None,
    wait_s: WaitS = 2.0,
) -> ResponseOut | Computing:
    """The points of every frequency response of a run, so far where it is under way, and the model's curve."""
    found = responses.of(run_id, transfer, wait_s, load_hz)
    if isinstance(found, Computing):
        response.status_code = 202
        return found
    return granted(found)
