"""`/api/v1/runs/{id}/prediction` and `…/predicted`."""

from typing import Annotated

from fastapi import APIRouter, Path, Query

from app.access.dependencies import Viewer
from app.dependencies import RunPredictionsService
from app.prediction.schemas import Prediction
from app.problems import PROBLEMS, granted
from app.runs.predicted_schemas import PredictedBands

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
RunId = Annotated[int, Path(ge=1, le=2**53)]
Seconds = Annotated[float, Query(ge=0, le=1e9, allow_inf_nan=False)]
MOST_POINTS = 20_000


@router.get("/{run_id}/prediction", operation_id="getRunPrediction")
def get_run_prediction(
    who: Viewer, run_id: RunId, predictions: RunPredictionsService
) -> Prediction:
    """The prediction that the run was started with."""
    return granted(predictions.prediction(run_id))


@router.get("/{run_id}/predicted", operation_id="getRunPredicted")
def get_run_predicted(
    who: Viewer,
    run_id: RunId,
    predictions: RunPredictionsService,
    from_s: Seconds = 0.0,
    to_s: Annotated[float | None, Query(ge=0, le=1e9, allow_inf_nan=False)] = None,
    points: Annotated[int, Query(ge=1, le=MOST_POINTS)] = 2000,
) -> PredictedBands:
    """Predicted force and displacement on the run's own time: holds put them off as they did the test."""
    return granted(predictions.bands(run_id, from_s, to_s, points))
