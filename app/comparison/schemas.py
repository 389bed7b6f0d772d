"""What is told of runs that are compared. The first that was asked for is the baseline."""

from datetime import datetime
from enum import StrEnum
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict

from app.recording.outcome import Outcome

Numbers = list[float | None]


class Align(StrEnum):
    """What of the runs lies on top of each other.

    `time`: their first ticks. `block`: the first ticks of a block. `phase`: the setpoint's top; then it is
    the mean cycle of each that is compared, over one cycle from 0 to 360°.
    """

    TIME = "time"
    BLOCK = "block"
    PHASE = "phase"


class ComparedRun(BaseModel):
    """A run that is compared; `offset_s` is the time of the run at which the common axis has its zero."""

    model_config = ConfigDict(from_attributes=True)

    id: int
    test_id: str
    test_name: str
    revision: int | None
    started_at: datetime
    operator: str
    outcome: Outcome | None
    verdict: Literal["pass", "fail", "unset"]
    duration_s: float | None
    software_version: str
    offset_s: float | None


class ComparedSeries(BaseModel):
    """Least and greatest of a run's channel at each place of the axis."""

    run_id: int
    min: Numbers
    max: Numbers


class ExceededOut(BaseModel):
    """From where to where a difference exceeds its tolerance, and the largest difference there.

    `peak` is null where only one of the two runs has numbers.
    """

    first: float
    last: float
    peak: float | None


class ComparedDifference(BaseModel):
    """A run less the baseline, tick against tick, and then in bins; `tolerance` is the least of each bin.

    `compared` counts the places at which both have a number, `one_sided` those that both recorded and that are
    a number in one alone: these exceed any tolerance. `exceeded_share` is of both kinds; null without a
    tolerance. What cannot be told as nothing was compared is null.
    """

    run_id: int
    min: Numbers
    max: Numbers
    tolerance: Numbers | None
    rms: float | None
    peak: float | None
    peak_at: float | None
    compared: int
    one_sided: int
    exceeded_share: float | None
    exceeded: list[ExceededOut]
    exceeded_in_all: int


class ComparedChannel(BaseModel):
    """One channel of all runs."""

    channel: str
    unit: str
    series: list[ComparedSeries]
    differences: list[ComparedDifference]


class OverlayOut(BaseModel):
    """Runs on one axis: `x` in seconds, or in degrees of a cycle. Without `decimated` each tick is told."""

    align: Align
    block: int | None
    x_unit: Literal["s", "°"]
    x: list[float]
    decimated: bool
    offsets_s: list[float | None]
    channels: list[ComparedChannel]


class ComparedValue(BaseModel):
    """A measurement of one run, by how much it differs from the baseline's, and whether that is tolerated."""

    run_id: int
    value: float | None
    difference: float | None
    within: bool | None


class MeasurementRow(BaseModel):
    """One measurement of all runs; block is null for the run as a whole."""

    block: int | None
    name: str
    unit: str
    values: list[ComparedValue]


class SettingRow(BaseModel):
    """A setting that is not the same in all runs, with its value in each, in their order."""

    part: Literal["definition", "controller", "interlocks", "rig"]
    path: str
    values: list[Any]


class RunComparison(BaseModel):
    """Runs beside one another."""

    baseline_id: int
    runs: list[ComparedRun]
    overlay: OverlayOut
    measurements: list[MeasurementRow]
    settings: list[SettingRow]
    settings_in_all: int


class TrendPoint(BaseModel):
    """A measurement of one run, with the limits that its test gave it."""

    model_config = ConfigDict(from_attributes=True)

    run_id: int
    started_at: datetime
    revision: int | None
    outcome: str | None
    value: float
    at_least: float | None
    at_most: float | None


class TrendLine(BaseModel):
    """The line through the values; slopes are a day, their interval holds the truth in 95 of 100 cases.

    `leans` says that a slope of zero is not in it.
    """

    model_config = ConfigDict(from_attributes=True)

    slope: float
    slope_low: float
    slope_high: float
    first: float
    last: float
    deviation: float
    leans: bool


class Trend(BaseModel):
    """A measurement over the runs of a test, oldest first; `runs_in_all` counts those before them too.

    `line` is null where there are too few runs.
    """

    measurement: str
    unit: str
    test_id: str
    block: int | None
    points: list[TrendPoint]
    runs_in_all: int
    mean: float | None
    line: TrendLine | None
