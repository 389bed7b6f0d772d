"""What a frequency response may leave to the console: how long to settle and to measure, how high, and where.

Everything that may be played is in the program beforehand; what turns out not to be needed is skipped.
"""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from app.definitions.quantities import Cycles, Number, SweptHz, Whole
from app.documents.fields import Document, wrong

Share = Annotated[Number, Field(gt=0, le=1)]


class Settle(Document):
    """Settle for `settle_cycles` at least, then until the response is steady."""

    until: Literal["steady"] = "steady"
    at_most_cycles: Cycles


class Confidence(Document):
    """A point is done once its 95 % interval is within so much either way; `measure_cycles` is the most."""

    gain_db: Annotated[Number, Field(ge=0.001, le=20)] = 0.05
    phase_deg: Annotated[Number, Field(ge=0.01, le=180)] = 0.5


class AutoLevel(Document):
    """Halve the amplitude of a point until the valve and the unit stay within these limits.

    Points go on at the level of the one before, and rise again where there is room for it.
    """

    valve_at_most: Share = 0.5
    displacement_at_most_m: Annotated[Number, Field(gt=0, le=1)] | None = None
    least_share: Annotated[Number, Field(ge=1 / 64, le=1)] = 0.125

    def shares(self) -> tuple[float, ...]:
        """Of the amplitude, each half the one before, as far as the least."""
        found = [1.0]
        while found[-1] / 2 >= self.least_share * (1 - 1e-9):
            found.append(found[-1] / 2)
        return tuple(found)


class AutoResolution(Document):
    """So many more points between two frequencies, where the response bends by more than this."""

    points: Annotated[Whole, Field(ge=1, le=20)]
    bend_db: Annotated[Number, Field(gt=0, le=100)] = 0.5
    bend_deg: Annotated[Number, Field(gt=0, le=360)] = 5.0


class RequiredBand(Document):
    """Between which limits gain and phase of the closed loop are to stay, from one frequency to another."""

    from_hz: SweptHz
    to_hz: SweptHz
    low_db: Number | None = None
    high_db: Number | None = None
    low_deg: Number | None = None
    high_deg: Number | None = None

    @model_validator(mode="after")
    def _checked(self) -> Self:
        if not self.from_hz < self.to_hz:
            raise wrong("to_hz", "must be above from_hz", value=self.to_hz, limit=self.from_hz)
        limits = (self.low_db, self.high_db, self.low_deg, self.high_deg)
        if all(limit is None for limit in limits):
            raise wrong("high_db", "one of low_db, high_db, low_deg and high_deg is needed")
        for low, high in (("low_db", "high_db"), ("low_deg", "high_deg")):
            a, b = getattr(self, low), getattr(self, high)
            if a is not None and b is not None and not a < b:
                raise wrong(high, f"must be above {low}, {a:g}", value=b, limit=a)
        return self
