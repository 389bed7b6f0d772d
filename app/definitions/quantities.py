"""The quantities of a definition as bounded types: numbers only, never text that looks like one."""

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, Strict

from app.definitions.limits import RIG
from app.histories.curve import LARGEST


def _whole(value: Any) -> Any:
    """`1e6` is a whole number too."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


Number = Annotated[float, Strict()]
Whole = Annotated[int, Strict(), BeforeValidator(_whole)]

ForceN = Annotated[Number, Field(ge=-RIG.force_limit_n, le=RIG.force_limit_n)]
SwingN = Annotated[Number, Field(gt=0, le=RIG.force_limit_n)]
AmplitudeN = Annotated[Number, Field(ge=0, le=RIG.force_limit_n)]
RateNS = Annotated[Number, Field(ge=RIG.force_rate_floor_n_s, le=RIG.force_rate_limit_n_s)]
PositionM = Annotated[Number, Field(ge=-RIG.stroke_limit_m, le=RIG.stroke_limit_m)]
SwingM = Annotated[Number, Field(gt=0, le=RIG.stroke_limit_m)]
AmplitudeM = Annotated[Number, Field(ge=0, le=RIG.stroke_limit_m)]
RateMS = Annotated[Number, Field(ge=RIG.velocity_floor_m_s, le=RIG.velocity_limit_m_s)]
FrequencyHz = Annotated[Number, Field(gt=0, lt=RIG.frequency_limit_hz)]
SampleRateHz = Annotated[Number, Field(gt=0, le=RIG.loop_rate_hz)]
OctavesS = Annotated[Number, Field(ge=1e-6, le=100)]
Sample = Annotated[Number, Field(ge=-LARGEST, le=LARGEST)]  # before its gain
Gain = Annotated[Number, Field(ge=-1e9, le=1e9)]
SweptHz = Annotated[Number, Field(ge=1e-6, lt=RIG.frequency_limit_hz)]
DurationS = Annotated[Number, Field(gt=0, le=RIG.duration_limit_s)]
RiseS = Annotated[Number, Field(ge=0, le=RIG.duration_limit_s)]
PhaseDeg = Annotated[Number, Field(ge=-360, le=360)]
Cycles = Annotated[Whole, Field(ge=1, le=RIG.cycle_limit)]
SettleCycles = Annotated[Whole, Field(ge=0, le=1_000_000)]
TaperCycles = Annotated[Number, Field(ge=0, le=1000)]
Times = Annotated[Whole, Field(ge=1, le=RIG.repeat_limit)]
