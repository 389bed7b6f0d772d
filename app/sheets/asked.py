"""What a sheet is asked for: bounded, unknown names refused, the same on the command line and in a request."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from app.documents.fields import Document, wrong

HIGHEST_HZ = 1999.0  # half the loop rate is 2,000
AMPLITUDES_N = (1e3, 2e3, 5e3, 10e3)  # of the table in the rig's data sheet

DiameterM = Annotated[float, Field(ge=1e-4, le=1e-2)]
AmplitudeN = Annotated[float, Field(ge=10, le=60e3)]
MeanN = Annotated[float, Field(ge=-50e3, le=50e3)]
Hz = Annotated[float, Field(ge=0.01, le=HIGHEST_HZ)]


class StaticAsked(Document):
    """Which orifices, at which pressure; without a diameter the one that the rig has."""

    orifice_diameter_m: tuple[DiameterM, ...] = Field(default=(), max_length=20)
    pressure_pa: float | None = Field(default=None, ge=1e5, le=35e6, description="p_s - p_t")
    points: int = Field(default=201, ge=3, le=2001)


class Band(Document):
    """Frequencies, evenly spread on a logarithmic axis."""

    from_hz: Hz = 1.0
    to_hz: Hz = 400.0
    points: int = Field(default=200, ge=2, le=1000)

    @model_validator(mode="after")
    def _upwards(self) -> Self:
        if not self.from_hz < self.to_hz:
            raise wrong("to_hz", f"must be above from_hz, {self.from_hz:g} Hz", value=self.to_hz)
        return self


class LinearAsked(Band):
    """Loads of which amplitudes and mean; `load_hz` puts the compensation into the loop."""

    amplitude_n: tuple[AmplitudeN, ...] = Field(default=AMPLITUDES_N, min_length=1, max_length=10)
    mean_n: MeanN = 0.0
    load_hz: Hz | None = None


class CompensatorAsked(Band):
    """A load of which amplitude and frequency, and where to tune the branch exactly."""

    from_hz: Hz = 0.1
    load_hz: Hz = 40.0
    amplitude_n: AmplitudeN = 3e3
    mean_n: MeanN = 0.0
    tune_hz: Hz | None = None
