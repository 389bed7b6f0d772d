"""`/api/v1/runs/{id}/prediction` and `…/predicted`."""

from fastapi import APIRouter

from app.access.dependencies import Viewer
from app.dependencies import RunPredictionsService
from app.parameters import Elapsed, Number, Points
from app.prediction.schemas import Prediction
from app.problems import PROBLEMS, granted
from app.runs.predicted_schemas import PredictedBands

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)


@router.get("/{run_id}/prediction", operation_id="getRunPrediction")
def get_run_prediction(
    who: Viewer, run_id: Number, predictions: RunPredictionsService
) -> Prediction:
    """The prediction that the run was started with."""
    return granted(predictions.prediction(run_id))


@router.get("/{run_id}/predicted", operation_id="getRunPredicted")
def get_run_predicted(
    who: Viewer,
    run_id: Number,
    predictions: RunPredictionsService,
    from_s: Elapsed = 0.0,
    to_s: Elapsed | None = None,
    points: Points = 2000,
) -> PredictedBands:
    """Predicted force and displacement on the run's own time, as far as it went as predicted; holds put them off."""
    return granted(predictions.bands(run_id, from_s, to_s, points))
