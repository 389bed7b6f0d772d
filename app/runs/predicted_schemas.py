"""What the requests about the prediction of a run give."""

from pydantic import BaseModel


class PredictedBands(BaseModel):
    """Least and greatest predicted values; `time_s` counts from the run's first tick."""

    time_s: list[float]
    force_min_n: list[float]
    force_max_n: list[float]
    displacement_min_m: list[float]
    displacement_max_m: list[float]
