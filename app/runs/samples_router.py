"""`/api/v1/runs/{id}/samples`."""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Response

from app.access.dependencies import Viewer
from app.dependencies import RunWindowsService
from app.problems import PROBLEMS, granted
from app.runs.schemas import RunSamples

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
Seconds = Annotated[float, Query(ge=0, le=1e9, allow_inf_nan=False)]
MOST_POINTS = 20_000


@router.get("/{run_id}/samples", operation_id="getRunSamples", response_model=RunSamples)
def get_run_samples(
    who: Viewer,
    run_id: Annotated[int, Path(ge=1, le=2**53)],
    windows: RunWindowsService,
    channels: Annotated[str, Query(max_length=2000, description="names, with commas between")],
    from_s: Seconds = 0.0,
    to_s: Annotated[float | None, Query(ge=0, le=1e9, allow_inf_nan=False)] = None,
    points: Annotated[int, Query(ge=1, le=MOST_POINTS)] = 2000,
) -> Response:
    """Least and greatest value in each of at most `points` stretches: every sample counts."""
    names = [name.strip() for name in channels.split(",") if name.strip()]
    found = granted(windows.window(run_id, names, from_s, to_s, points))
    # Written by Pydantic in one go: FastAPI would look at each number once more.
    return Response(found.model_dump_json(), media_type="application/json")
