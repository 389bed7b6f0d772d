"""How far a value is from the limit of a detector: below zero exactly where it is violated."""

import math

from app.interlocks.detector import Detector
from rtcore.interlocks import Comparison


def margin(detector: Detector, value: float) -> float | None:
    """In the unit of the value; None where that is no number."""
    if not math.isfinite(value):
        return None
    threshold, low = detector.threshold, detector.low
    match detector.comparison:
        case Comparison.ABOVE:
            return threshold - value
        case Comparison.BELOW:
            return value - threshold
        case Comparison.OUTSIDE if low is not None:
            return min(threshold - value, value - low)
        case _:
            return threshold - abs(value)


def share(detector: Detector, margin: float | None) -> float | None:
    """A margin as a share of the limit, of a band as a share of half its width; None where there is none."""
    whole = abs(detector.threshold)
    if detector.comparison is Comparison.OUTSIDE and detector.low is not None:
        whole = 0.5 * (detector.threshold - detector.low)
    return None if margin is None or whole == 0.0 else margin / whole
