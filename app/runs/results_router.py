"""`/api/v1/runs/{id}/measurements` and `/api/v1/runs/{id}/acquisitions`."""

from typing import Annotated

from fastapi import APIRouter, Path, Query, Response
from fastapi.responses import StreamingResponse

from app.access.dependencies import Viewer
from app.dependencies import ResultsService
from app.parameters import Number
from app.problems import PROBLEMS, granted
from app.runs.results_schemas import AcquisitionRows, AcquisitionSummary, RunMeasurements

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
Index = Annotated[int, Path(ge=0, le=1000, description="its place in the test, from 0")]
MOST_ROWS = 100_000


@router.get("/{run_id}/measurements", operation_id="getRunMeasurements")
def get_run_measurements(who: Viewer, run_id: Number, results: ResultsService) -> RunMeasurements:
    """What was measured of the run and of each block, and how that was judged."""
    return granted(results.measurements(run_id))


@router.get("/{run_id}/acquisitions", operation_id="listRunAcquisitions")
def list_run_acquisitions(
    who: Viewer, run_id: Number, results: ResultsService
) -> list[AcquisitionSummary]:
    """The tables that the test asked for beside the record; of a run under way, so far."""
    return granted(results.acquisitions(run_id))


class _Csv(StreamingResponse):
    media_type = "text/csv"


@router.get(
    "/{run_id}/acquisitions/{index}.csv",
    operation_id="getRunAcquisitionCsv",
    response_class=_Csv,
)
def get_run_acquisition_csv(
    who: Viewer, run_id: Number, index: Index, results: ResultsService
) -> StreamingResponse:
    """A whole table as CSV, with the units in its first line."""
    lines = granted(results.as_csv(run_id, index))
    name = f"forcerig-run-{run_id}-acquisition-{index}.csv"
    headers = {"Content-Disposition": f'attachment; filename="{name}"'}
    return _Csv(lines, headers=headers)


@router.get(
    "/{run_id}/acquisitions/{index}",
    operation_id="getRunAcquisition",
    response_model=AcquisitionRows,
)
def get_run_acquisition(
    who: Viewer,
    run_id: Number,
    index: Index,
    results: ResultsService,
    from_row: Annotated[int, Query(ge=0, le=2**53)] = 0,
    rows: Annotated[int, Query(ge=1, le=MOST_ROWS)] = MOST_ROWS,
) -> Response:
    """Rows of a table, column by column."""
    found = granted(results.rows(run_id, index, from_row, rows))
    return Response(found.model_dump_json(), media_type="application/json")
