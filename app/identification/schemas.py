"""What an identification is asked for, and what comes of it."""

from typing import Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.identification.parameters import PARAMETER, Group

MOST_RUNS = 8


class Fit(BaseModel):
    """Which parameters are fitted, and to how many windows; `unit` and SI throughout."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    parameters: tuple[str, ...] = Field(
        default=tuple(PARAMETER),
        min_length=1,
        max_length=len(PARAMETER),
        description="paths in the rig, such as structure.k_pl; all that there are without",
    )
    windows: int = Field(
        default=20, ge=4, le=100, description="of 0.4 s, that the model is fitted to"
    )
    candidates: int = Field(default=72, ge=8, le=1000, description="that they are chosen from")

    @model_validator(mode="after")
    def _known(self) -> Self:
        unknown = [path for path in self.parameters if path not in PARAMETER]
        if unknown:
            raise ValueError(f"{', '.join(unknown)}: must be among {', '.join(PARAMETER)}")
        if len(set(self.parameters)) < len(self.parameters):
            raise ValueError("must each be named once")
        return self


class Entangled(BaseModel):
    """The parameter that another one can be told from least."""

    path: str
    correlation: float


class FittedParameter(BaseModel):
    """A parameter before and after; `low` to `high` holds the true one with 95 % confidence.

    Where `determined` is false the data do not tell it: then `after` is not what the rig is adopted with.
    """

    path: str
    title: str
    unit: str
    group: Group
    before: float
    after: float
    low: float
    high: float
    half_percent: float | None = Field(
        description="half the interval, of the value; null at nothing"
    )
    at_bound: bool
    determined: bool
    entangled: Entangled | None


class ChannelResidual(BaseModel):
    """What the model leaves of a channel over the chosen windows; `noise` is what the channel has by itself."""

    channel: str
    unit: str
    noise: float
    before_rms: float
    after_rms: float


class WindowUsed(BaseModel):
    """A window that the model was fitted to, counted from its run's first tick."""

    run_id: int
    from_s: float
    to_s: float


class Goodness(BaseModel):
    """Eq (4) of the paper over windows that the fit has not seen, in %, the model driven by the recorded commands."""

    before_percent: float | None
    after_percent: float | None
    windows: int


class Identified(BaseModel):
    """What came of it. `correlation` is in the order of `parameters`."""

    parameters: list[FittedParameter]
    correlation: list[list[float]]
    residuals: list[ChannelResidual]
    force_zeros_n: list[float]
    goodness: Goodness
    windows: list[WindowUsed]
    iterations: int
    settled: bool
    took_s: float
    notes: list[str]

    def values(self) -> dict[str, float]:
        """What a rig is to be changed to: what the data determine."""
        return {p.path: p.after for p in self.parameters if p.determined}
