"""The blocks of a test: what the force does, in sequence."""

import math
from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from app.definitions.checks import exactly_one, lasts, within
from app.definitions.courses import Reach, TimeCourse
from app.definitions.limits import RIG
from app.definitions.quantities import (
    AmplitudeN,
    Cycles,
    DurationS,
    ForceN,
    FrequencyHz,
    OctavesS,
    PhaseDeg,
    RateNS,
    RiseS,
    Sample,
    SweptHz,
    TaperCycles,
    Times,
)
from app.definitions.responses import FrequencyResponse
from app.documents.fields import Document, wrong

REACH = Reach(RIG.force_limit_n, RIG.force_rate_limit_n_s, RIG.force_bandwidth_hz, "N")


class Hold(Document):
    """Stay at a force, or where the setpoint is."""

    kind: Literal["hold"] = "hold"
    force_n: ForceN | None = None
    duration_s: DurationS


class Ramp(Document):
    """To a force at a constant rate, or within a time."""

    kind: Literal["ramp"] = "ramp"
    to_n: ForceN
    rate_n_s: RateNS | None = None
    duration_s: DurationS | None = None

    @model_validator(mode="after")
    def _checked(self) -> Self:
        exactly_one("rate_n_s", self.rate_n_s, "duration_s", self.duration_s)
        return self


class Step(Document):
    """To a force at once, or along half a cosine in `rise_s`; then stay there."""

    kind: Literal["step"] = "step"
    to_n: ForceN
    hold_s: DurationS
    rise_s: RiseS = 0.0


class Harmonic(Document):
    """A sine about a mean. `cycles` and `duration_s` count full-amplitude cycles only."""

    kind: Literal["harmonic"] = "harmonic"
    mean_n: ForceN = 0.0
    amplitude_n: AmplitudeN
    frequency_hz: FrequencyHz
    cycles: Cycles | None = None
    duration_s: DurationS | None = None
    phase_deg: PhaseDeg = 0.0
    taper_cycles: TaperCycles = 2.0

    @model_validator(mode="after")
    def _checked(self) -> Self:
        exactly_one("cycles", self.cycles, "duration_s", self.duration_s)
        within("amplitude_n", self.mean_n, self.amplitude_n, RIG.force_limit_n, "N")
        lasts("cycles", self.cycles, self.frequency_hz)
        return self


class Sweep(Document):
    """A sine whose frequency moves, up or down; a log sweep takes as long for each octave.

    `rate_octaves_s` of a linear sweep is its rate on the whole.
    """

    kind: Literal["sweep"] = "sweep"
    mean_n: ForceN = 0.0
    amplitude_n: AmplitudeN
    from_hz: SweptHz
    to_hz: SweptHz
    rate_octaves_s: OctavesS | None = None
    duration_s: DurationS | None = None
    law: Literal["log", "linear"] = "log"
    taper_cycles: TaperCycles = 2.0

    @model_validator(mode="after")
    def _checked(self) -> Self:
        exactly_one("rate_octaves_s", self.rate_octaves_s, "duration_s", self.duration_s)
        within("amplitude_n", self.mean_n, self.amplitude_n, RIG.force_limit_n, "N")
        if self.from_hz == self.to_hz:
            raise wrong("to_hz", "must differ from from_hz: use harmonic", value=self.to_hz)
        return self

    @property
    def lasts_s(self) -> float:
        """From the first frequency to the last, tapers left out."""
        octaves = abs(math.log2(self.to_hz) - math.log2(self.from_hz))
        return self.duration_s or octaves / (self.rate_octaves_s or 1.0)


class Layer(Document):
    """One layer of a load spectrum."""

    mean_n: ForceN = 0.0
    amplitude_n: AmplitudeN
    frequency_hz: FrequencyHz
    cycles: Cycles

    @model_validator(mode="after")
    def _checked(self) -> Self:
        within("amplitude_n", self.mean_n, self.amplitude_n, RIG.force_limit_n, "N")
        lasts("cycles", self.cycles, self.frequency_hz)
        return self


class Layers(Document):
    """A load spectrum: layers of harmonic load that change into one another without a stop."""

    kind: Literal["layers"] = "layers"
    layers: tuple[Layer, ...] = Field(min_length=1, max_length=RIG.block_limit)
    repeats: Times = 1
    transition_s: DurationS


class TimeHistory(TimeCourse):
    """Forces sampled before, from a file or from the test itself, times `gain`."""

    samples_n: tuple[Sample, ...] | None = Field(
        default=None, min_length=2, max_length=RIG.sample_limit
    )

    @model_validator(mode="after")
    def _checked(self, info: ValidationInfo) -> Self:
        self._find("samples_n", self.samples_n, REACH, info.context)
        return self


class Repeat(Document):
    """Blocks, so many times in all."""

    kind: Literal["repeat"] = "repeat"
    times: Times
    blocks: "tuple[Block, ...]" = Field(min_length=1, max_length=RIG.block_limit)

    @model_validator(mode="after")
    def _checked(self) -> Self:
        if any(isinstance(b, FrequencyResponse) and b.is_adaptive for b in self.blocks):
            message = (
                "a frequency response that adapts cannot be repeated: put it beside the repeat"
            )
            raise wrong("blocks", message)
        return self


Block = Annotated[
    Hold | Ramp | Step | Harmonic | Layers | Sweep | FrequencyResponse | TimeHistory | Repeat,
    Field(discriminator="kind"),
]
Repeat.model_rebuild()
