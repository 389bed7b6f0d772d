"""From what was watched to margins: how near each detector comes to its trip."""

import math
from typing import Any

from app.definitions.limits import RIG
from app.interlocks.margin import share
from app.interlocks.table import Detector, Interlocks
from app.prediction.schemas import Margin
from app.prediction.watch import NOT_PREDICTED, SENSORS, Watch
from rtcore.interlocks import Comparison, Quantity

LIVE_ONLY = "Only the live rig can tell"
NO_FAULTS = "The virtual rig's sensors do not fail of themselves"
NOT_ARMED = "Not armed during a test"
NO_NUMBER = "What it watches was not a number"
TOO_SHORT = "Not armed for as long as it wants to see it"


def margins_of(interlocks: Interlocks, watch: Watch, cycles_left_out: int = 0) -> list[Margin]:
    """The margin to every detector, in the order of the table; of a test that was cut, to the whole of it."""
    pairs = zip(interlocks.detectors, watch.extremes, strict=True)
    return [_margin(detector, extreme, cycles_left_out) for detector, extreme in pairs]


def _margin(detector: Detector, extreme: Any, cycles_left_out: int) -> Margin:
    excess = float(extreme["excess"])
    counts = detector.quantity is Quantity.CYCLES and detector.comparison is not Comparison.BELOW
    beyond = cycles_left_out if counts else 0
    excess += beyond
    note = _note(detector, extreme, trips=excess > 0)
    if note == NO_NUMBER:
        excess = max(1.0, abs(detector.threshold))
    known = math.isfinite(excess) and note in ("", NO_NUMBER)
    placed = known and not beyond  # what was cut away has no place in the rest
    tick = int(extreme["tick"])
    margin = -excess if known else None
    return Margin(
        detector=detector.name,
        quantity=detector.quantity.name.lower(),
        form=detector.form.name.lower(),
        unit=detector.unit,
        threshold=detector.threshold,
        low=detector.low,
        extreme=_extreme(detector, excess, extreme) if known and not note else None,
        margin=margin,
        margin_share=share(detector, margin),
        tick=tick if placed else None,
        time_s=tick * RIG.period_s if placed else None,
        block=int(extreme["block"]) if placed and extreme["block"] >= 0 else None,
        action=detector.action.name.lower(),
        predicted=note not in (LIVE_ONLY, NO_FAULTS),
        note=note,
    )


def _extreme(detector: Detector, excess: float, extreme: Any) -> float:
    """The value that is so far beyond, or short of, the end that it comes nearest to."""
    if detector.comparison is Comparison.OUTSIDE and extreme["below"] and detector.low is not None:
        return detector.low - excess
    sign = -1.0 if detector.comparison is Comparison.BELOW else 1.0
    return detector.threshold + sign * excess


def _note(detector: Detector, extreme: Any, *, trips: bool) -> str:
    """Why nothing can be said of a detector; empty where something can."""
    if detector.quantity in NOT_PREDICTED:
        return LIVE_ONLY
    if detector.quantity in SENSORS and not trips:
        return NO_FAULTS
    if extreme["ever_armed"] == 0:
        return NOT_ARMED
    if math.isfinite(extreme["excess"]):
        return ""
    return NO_NUMBER if trips else TOO_SHORT
