"""What a prediction means for a start: one that is refused never starts, a caution needs a reason."""

from app.errors import Code, Refusal
from app.prediction.predicting import Predicted
from app.prediction.schemas import Computing, Prediction, PredictionVerdict

SAID = 3  # reasons in the sentence; all of them are with it


def gate(
    found: Predicted | Computing | Refusal, override_reason: str | None
) -> Predicted | Refusal:
    """The prediction, where it lets the test start."""
    if isinstance(found, Refusal):
        return found
    if isinstance(found, Computing):
        return _pending(found)
    prediction = found.prediction
    if prediction.verdict is PredictionVerdict.REFUSED:
        return _refusal(Code.PREDICTION_REFUSED, "Cannot start", prediction)
    if prediction.verdict is PredictionVerdict.CAUTION and not (override_reason or "").strip():
        how = "Starting needs a reason that is kept with the run"
        return _refusal(Code.OVERRIDE_NEEDED, how, prediction)
    return found


def _pending(computing: Computing) -> Refusal:
    left_s = computing.seconds_left
    about = "" if left_s is None else f", for about {max(1.0, left_s):,.0f} s more"
    detail = f"Cannot start yet: the test is still being predicted{about}; try again then"
    shown = {"share": computing.share, "seconds_left": left_s}
    return Refusal(Code.PREDICTION_PENDING, detail, about=shown)


def _refusal(code: Code, how: str, prediction: Prediction) -> Refusal:
    texts = [reason.text for reason in prediction.reasons[:SAID]]
    shown = prediction.model_dump(mode="json", include={"verdict", "reasons", "key"})
    return Refusal(code, f"{how}: {'; '.join(texts)}", about={"prediction": shown})
