"""What the unit under test is commanded to do meanwhile, in metres."""

from dataclasses import replace
from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from app.definitions.checks import (
    exactly_one,
    lasts,
    slow_enough,
    slow_enough_together,
    within,
)
from app.definitions.courses import Reach, TimeCourse
from app.definitions.limits import RIG
from app.definitions.multisine import Grid, moving_period_of
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
    SettleCycles,
    SweptHz,
    SwingM,
    TaperCycles,
    Whole,
)
from app.definitions.responses import Frequencies, grid_of, refuse_long_period
from app.documents.fields import Document
from app.histories.history import History

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


class MotionMultisine(Document):
    """Many sines at once about a mean, which measures the unit's position response; cycles are periods of the whole.

    Its greatest value is the amplitude, its velocity has the least crest. Above `corner_hz` the sines fall with
    their frequency. Realisations follow one another, each with phases of its own: the steps of a displacement
    transducer without noise are the same in every period, and only with other phases are they others.
    """

    kind: Literal["multisine"] = "multisine"
    mean_m: PositionM = 0.0
    amplitude_m: SwingM
    frequencies_hz: Frequencies
    corner_hz: SweptHz | None = None
    settle_cycles: SettleCycles = 1
    measure_cycles: Cycles = 2
    realisations: Annotated[Whole, Field(ge=2, le=20)] = 4

    @model_validator(mode="after")
    def _checked(self) -> Self:
        within("amplitude_m", self.mean_m, self.amplitude_m, RIG.stroke_limit_m, "m")
        refuse_long_period(self.grid())
        steepest = max(period.statistics.steepest for period in self.periods())
        slow_enough_together("amplitude_m", self.amplitude_m, steepest * RIG.loop_rate_hz)
        return self

    def grid(self) -> Grid:
        """The period and the lines in it."""
        return grid_of(self.frequencies_hz)

    def periods(self) -> list[History]:
        """A period of each realisation, its greatest value 1."""
        grid = self.grid()
        numbers = range(1, self.realisations + 1)
        return [moving_period_of(replace(grid, realisation=n), self.corner_hz) for n in numbers]


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
    MotionHold | MotionRamp | MotionStep | MotionHarmonic | MotionMultisine | MotionHistory,
    Field(discriminator="kind"),
]
