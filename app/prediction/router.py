"""`/api/v1/tests/…/prediction`."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response
from pydantic import BaseModel, ConfigDict, Field

from app.access.dependencies import Viewer
from app.catalogue import texts
from app.catalogue.schemas import LONGEST_ID, Number, TestText
from app.dependencies import CatalogueService, PredictionsService
from app.errors import Refusal
from app.prediction.predicting import Predicted
from app.prediction.schemas import Computing, Prediction
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/tests", tags=["tests"], responses=PROBLEMS)
LONGEST_WAIT_S = 60.0


_COMPUTING: dict[int | str, dict[str, Any]] = {
    202: {"model": Computing, "description": "Still being computed: ask again"}
}
WaitS = Annotated[float, Field(ge=0, le=LONGEST_WAIT_S)]


class PredictionAsked(BaseModel):
    """Which revision to predict, the newest by default, and how long to wait for it."""

    model_config = ConfigDict(extra="forbid")

    revision: Number | None = None
    wait_s: WaitS = 30.0


class TextPredictionAsked(TestText):
    """A test that is not saved, and how long to wait for its prediction."""

    wait_s: WaitS = 30.0


@router.post("/prediction", operation_id="predictText", responses=_COMPUTING)
def predict_text(
    who: Viewer,
    body: TextPredictionAsked,
    catalogue: CatalogueService,
    predictions: PredictionsService,
    response: Response,
) -> Prediction | Computing:
    """Run a test that is not saved on the virtual rig, with the present settings."""
    written = granted(texts.read(catalogue.reader, body))
    found = predictions.of(written.definition, body.wait_s, draft=True)
    return _answer(found, response)


@router.post("/{test_id}/prediction", operation_id="predictTest", responses=_COMPUTING)
def predict_test(
    who: Viewer,
    test_id: Annotated[str, Path(max_length=LONGEST_ID)],
    catalogue: CatalogueService,
    predictions: PredictionsService,
    response: Response,
    body: PredictionAsked | None = None,
) -> Prediction | Computing:
    """Run a test on the virtual rig, with the present settings: what a start of it is held against."""
    asked = body or PredictionAsked()
    stored = granted(catalogue.definition_of(test_id, asked.revision))
    return _answer(predictions.of(stored.definition, asked.wait_s), response)


def _answer(found: Predicted | Computing | Refusal, response: Response) -> Prediction | Computing:
    if isinstance(found, Computing):
        response.status_code = 202
        return found
    return granted(found).prediction
