"""A prediction that nothing was computed for: clear, and empty."""

from app.prediction.predicting import Predicted
from app.prediction.schemas import Peaks, Prediction, PredictionVerdict, Valve


def a_prediction(key: str = "") -> Predicted:
    """Of a test of 0.1 s, without a series of force and displacement."""
    prediction = Prediction(
        verdict=PredictionVerdict.CLEAR,
        reasons=[],
        duration_s=0.1,
        predicted_s=0.1,
        shortened=[],
        margins=[],
        valve=Valve(peak=0.0, saturation_share=0.0, longest_saturation_s=0.0),
        peaks=Peaks(**dict.fromkeys(Peaks.model_fields)),
        blocks=[],
        criteria=[],
        outcome="completed",
        reason=None,
        computed_in_s=0.1,
        speed=1.0,
        seed=1,
        key=key,
    )
    return Predicted(prediction, None, 0)
