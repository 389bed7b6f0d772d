"""What the unit under test is commanded to do meanwhile, in metres."""

from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from app.definitions.checks import exactly_one, lasts, slow_enough, within
from app.definitions.courses import Reach, TimeCourse
from app.definitions.limits import RIG
from app.definitions.quantities import (
    AmplitudeM,
    Cycles,
    DurationS,
    FrequencyHz,
    PhaseDeg,
    PositionM,
    RateMS,
    RiseS,
    Sample,
    TaperCycles,
)
from app.documents.fields import Document

REACH = Reach(RIG.stroke_limit_m, RIG.velocity_limit_m_s, RIG.motion_bandwidth_hz, "m")


class MotionHold(Document):
    """Stay at a position, or where the unit is."""

    kind: Literal["hold"] = "hold"
    displacement_m: PositionM | None = None
    duration_s: DurationS


class MotionRamp(Document):
    """To a position at a constant velocity, or within a time."""

    kind: Literal["ramp"] = "ramp"
    to_m: PositionM
    rate_m_s: RateMS | None = None
    duration_s: DurationS | None = None

    @model_validator(mode="after")
    def _checked(self) -> Self:
        exactly_one("rate_m_s", self.rate_m_s, "duration_s", self.duration_s)
        return self


class MotionStep(Document):
    """To a position at once, as fast as the unit's own servo goes, or along half a cosine."""

    kind: Literal["step"] = "step"
    to_m: PositionM
    hold_s: DurationS
    rise_s: RiseS = 0.0


class MotionHarmonic(Document):
    """A sine about a mean. `cycles` and `duration_s` count full-amplitude cycles only."""

    kind: Literal["harmonic"] = "harmonic"
    mean_m: PositionM = 0.0
    amplitude_m: AmplitudeM
    frequency_hz: FrequencyHz
    cycles: Cycles | None = None
    duration_s: DurationS | None = None
    phase_deg: PhaseDeg = 0.0
    taper_cycles: TaperCycles = 1.0

    @model_validator(mode="after")
    def _checked(self) -> Self:
        exactly_one("cycles", self.cycles, "duration_s", self.duration_s)
        within("amplitude_m", self.mean_m, self.amplitude_m, RIG.stroke_limit_m, "m")
        slow_enough("amplitude_m", self.amplitude_m, self.frequency_hz)
        lasts("cycles", self.cycles, self.frequency_hz)
        return self


class MotionHistory(TimeCourse):
    """Displacements sampled before, from a file or from the test itself, times `gain`."""

    samples_m: tuple[Sample, ...] | None = Field(
        default=None, min_length=2, max_length=RIG.sample_limit
    )

    @model_validator(mode="after")
    def _checked(self, info: ValidationInfo) -> Self:
        self._find("samples_m", self.samples_m, REACH, info.context)
        return self


Motion = Annotated[
    MotionHold | MotionRamp | MotionStep | MotionHarmonic | MotionHistory,
    Field(discriminator="kind"),
]
