"""`/api/v1/runs/{id}/analysis`."""

from typing import Annotated, Any

from fastapi import APIRouter, Query, Response

from app.access.dependencies import Viewer
from app.dependencies import AnalysesService
from app.parameters import Number
from app.prediction.schemas import Computing
from app.problems import PROBLEMS, granted
from app.run_analysis.schemas import RunAnalysis

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
LONGEST_WAIT_S = 30.0
COMPUTING: dict[int | str, dict[str, Any]] = {
    202: {"model": Computing, "description": "Still being computed: ask again"}
}
WaitS = Annotated[float, Query(ge=0, le=LONGEST_WAIT_S, allow_inf_nan=False)]


@router.get("/{run_id}/analysis", operation_id="getRunAnalysis", responses=COMPUTING)
def get_run_analysis(
    who: Viewer,
    run_id: Number,
    analyses: AnalysesService,
    response: Response,
    wait_s: WaitS = 2.0,
) -> RunAnalysis | Computing:
    """Steps, cycles, harmonics, rainflow counts, damage and uncertainty of a run; computed once and kept."""
    found = analyses.of(run_id, wait_s)
    if isinstance(found, Computing):
        response.status_code = 202
        return found
    return granted(found)
