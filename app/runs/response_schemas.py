"""What is told of a run's frequency responses."""

from typing import Literal

from pydantic import BaseModel

Method = Literal["stepped_sine", "multisine", "sweep"]
TransferName = Literal[
    "force",
    "plant",
    "motion",
    "disturbance",
    "compliance",
    "position",
    "stiffness",
    "admittance",
    "loop",
]


class ResponsePointOut(BaseModel):
    """A point with its 95 % intervals; `gain` in the transfer's unit, `gain_db` of one without a unit.

    `asked_n` is the amplitude of its series, of which it may have been backed off to `amplitude_n`. `amplitude_m` is
    that of the motion, null where it is the force that was led. Bounds and `coherence` are null where there are
    none yet. `noise_std` and `nonlinear_std` are parts of the gain's deviation.
    """

    frequency_hz: float
    amplitude_n: float
    asked_n: float
    amplitude_m: float | None
    mean_n: float
    gain: float
    gain_db: float | None
    phase_deg: float
    gain_low: float
    gain_high: float | None
    phase_low_deg: float
    phase_high_deg: float
    coherence: float | None
    distortion_percent: float | None
    noise_std: float | None
    nonlinear_std: float | None
    cycles: int
    settled: bool


class PeakOut(BaseModel):
    """A peak or a dip."""

    frequency_hz: float
    gain_db: float


class ExtremesOut(BaseModel):
    """What a Bode diagram is asked for first; null where there is none within the frequencies measured."""

    peak: PeakOut | None = None
    dip: PeakOut | None = None
    minus_3_db_hz: float | None = None
    minus_90_deg_hz: float | None = None


class ResponseSeries(BaseModel):
    """The points of one block, amplitude and mean, by frequency. `amplitude_n` is that which was asked for.

    Of the position response `block` counts motions, `amplitude_m` is the motion's and `mean_n` the force meanwhile.
    """

    block: int
    method: Method
    amplitude_n: float
    amplitude_m: float | None
    mean_n: float
    points: list[ResponsePointOut]
    extremes: ExtremesOut


class ModelCurve(BaseModel):
    """The linear model's response at an amplitude and mean."""

    amplitude_n: float
    mean_n: float
    frequencies_hz: list[float]
    gain: list[float]
    phase_deg: list[float]


class LoopMargins(BaseModel):
    """Of a series of the open loop, between the frequencies that were measured; null where it does not cross.

    `worst_sensitivity` is the largest 1/|1 + L|; the gain margin is at `turnover_hz`.
    """

    block: int
    method: Method
    amplitude_n: float
    mean_n: float
    crossover_hz: float | None
    phase_margin_deg: float | None
    gain_margin_db: float | None
    turnover_hz: float | None
    worst_sensitivity: float | None


class BandOut(BaseModel):
    """A requirement band of the test."""

    from_hz: float
    to_hz: float
    low_db: float | None
    high_db: float | None
    low_deg: float | None
    high_deg: float | None


class ResponseProgress(BaseModel):
    """How many points there are, of how many so far expected."""

    points: int
    of: int
    seconds_left: float | None


class ResponseOut(BaseModel):
    """A transfer of a run at all points that there are, the model's beside it, and what was required.

    `margins` are those of the open loop, of each of its series in turn; of every other transfer there are none.
    """

    transfer: TransferName
    unit: str
    available: list[TransferName]
    series: list[ResponseSeries]
    model: list[ModelCurve]
    bands: list[BandOut]
    margins: list[LoopMargins]
    progress: ResponseProgress | None


class ResponseFrame(BaseModel):
    """On the live stream, whenever a point is made or changes; of several of one point the newest wins."""

    type: Literal["response"] = "response"
    run: int
    block: int
    transfer: TransferName
    point: ResponsePointOut
