"""`/api/v1/runs`."""

from typing import Annotated

from fastapi import APIRouter, Path, Query
from fastapi.responses import FileResponse

from app.dependencies import RunsService, StarterService
from app.problems import PROBLEMS, granted
from app.runs.schemas import RunDetail, RunEvents, RunPage, RunStart, RunSummary

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
RunId = Annotated[int, Path(ge=1, le=2**53)]


@router.post("", status_code=201, operation_id="startRun")
def start_run(body: RunStart, starter: StarterService) -> RunSummary:
    """Start a test. Answers once the loop has begun it."""
    return RunSummary.of(granted(starter.start(body)))


@router.get("", operation_id="listRuns")
def list_runs(
    runs: RunsService,
    limit: Annotated[int, Query(ge=1, le=200)] = 50,
    before: Annotated[int | None, Query(ge=1, le=2**53)] = None,
) -> RunPage:
    """The newest runs first; `next` of a page is `before` of the page after it."""
    return runs.page(limit, before)


@router.get("/{run_id}", operation_id="getRun")
def get_run(run_id: RunId, runs: RunsService) -> RunDetail:
    """A run with everything that it was made with."""
    return granted(runs.detail(run_id))


@router.get("/{run_id}/events", operation_id="listRunEvents")
def list_run_events(run_id: RunId, runs: RunsService) -> RunEvents:
    """What the loop reported during the run, in order."""
    return granted(runs.events(run_id))


@router.get("/{run_id}/data.parquet", operation_id="getRunParquet", response_class=FileResponse)
def get_run_parquet(run_id: RunId, runs: RunsService) -> FileResponse:
    """Every tick and every channel, with the frozen definition and settings in its metadata."""
    path = granted(runs.parquet(run_id))
    name = f"forcerig-run-{run_id}.parquet"
    return FileResponse(path, media_type="application/vnd.apache.parquet", filename=name)
