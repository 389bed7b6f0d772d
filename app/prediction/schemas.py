"""A prediction, as requests give it and as a run keeps it."""

from enum import StrEnum
from typing import Literal

from pydantic import BaseModel


class PredictionVerdict(StrEnum):
    """What a prediction means for a start: nothing stands against it, a reason is needed, or never."""

    CLEAR = "clear"
    CAUTION = "caution"
    REFUSED = "refused"


Severity = Literal["caution", "refused"]


class Reason(BaseModel):
    """Why a prediction is not clear, in a sentence to act on; where and when, counted from the start."""

    code: str
    text: str
    severity: Severity
    block: int | None = None
    time_s: float | None = None


class CutOut(BaseModel):
    """What of the test was not predicted: `block 3: one of 1,000,000 passes`."""

    path: str
    text: str


class Margin(BaseModel):
    """How near a detector comes to its trip.

    `threshold` is the upper end of a band, `low` its lower one.
    `extreme` is the value that lasts as long as the detector wants it to; `margin` is what is left to the
    threshold, below zero where it trips. Both are null where nothing can be said, and `note` says why.
    """

    detector: str
    quantity: str
    form: str = "value"
    unit: str | None
    threshold: float
    low: float | None = None
    extreme: float | None
    margin: float | None
    margin_share: float | None
    tick: int | None
    time_s: float | None
    block: int | None
    action: str
    predicted: bool
    note: str = ""


class Valve(BaseModel):
    """The valve command: its peak, the share of the test at its limit, and the longest stretch of that."""

    peak: float
    saturation_share: float
    longest_saturation_s: float


class Peaks(BaseModel):
    """The largest magnitudes, null where the test cannot begin.

    The flow is the pump's, through the supply line; the droop is what its pressure lacks at the manifold.
    """

    force_n: float | None
    displacement_m: float | None
    velocity_m_s: float | None
    supply_flow_m3_s: float | None
    pressure_droop_pa: float | None
    force_error_n: float | None


class MeasurementOut(BaseModel):
    """A measurement that has a value."""

    name: str
    unit: str
    value: float


class BlockPrediction(BaseModel):
    """A block of the test, over all ticks in which it was played."""

    index: int
    kind: str
    force_error_rms_n: float | None
    force_error_peak_n: float | None
    peak_force_n: float | None
    saturation_share: float | None
    saturated_s: float | None
    longest_saturation_s: float | None
    measurements: list[MeasurementOut] = []


class CriterionOut(BaseModel):
    """An acceptance criterion, judged on the prediction."""

    measurement: str
    unit: str
    block: int | None
    value: float | None
    at_least: float | None
    at_most: float | None
    outcome: Literal["pass", "fail", "unset"]


class Prediction(BaseModel):
    """A test run on the virtual rig before it runs on the real one."""

    verdict: PredictionVerdict
    reasons: list[Reason]
    duration_s: float
    predicted_s: float
    shortened: list[CutOut]
    margins: list[Margin]
    valve: Valve
    peaks: Peaks
    blocks: list[BlockPrediction]
    criteria: list[CriterionOut]
    outcome: str
    reason: str | None
    computed_in_s: float
    speed: float
    seed: int
    key: str


class Computing(BaseModel):
    """A prediction that is under way; ask again for it."""

    state: Literal["computing"] = "computing"
    share: float
    seconds_left: float | None
