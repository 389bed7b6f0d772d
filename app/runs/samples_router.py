"""`/api/v1/runs/{id}/samples`."""

from fastapi import APIRouter, Response

from app.access.dependencies import Viewer
from app.dependencies import RunWindowsService
from app.parameters import Channels, Elapsed, Number, Points, names_in
from app.problems import PROBLEMS, granted
from app.runs.schemas import RunSamples

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)


@router.get("/{run_id}/samples", operation_id="getRunSamples", response_model=RunSamples)
def get_run_samples(
    who: Viewer,
    run_id: Number,
    windows: RunWindowsService,
    channels: Channels,
    from_s: Elapsed = 0.0,
    to_s: Elapsed | None = None,
    points: Points = 2000,
) -> Response:
    """Least and greatest value in each of at most `points` stretches: every sample counts."""
    names = names_in(channels)
    found = granted(windows.window(run_id, names, from_s, to_s, points))
    # Written by Pydantic in one go: FastAPI would look at each number once more.
    return Response(found.model_dump_json(), media_type="application/json")
