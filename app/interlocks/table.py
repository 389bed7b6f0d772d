"""The table of detectors: frozen and bounded."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from app.documents.fields import Document, wrong
from app.documents.units import unit_of
from app.interlocks.names import ByName
from rtcore.interlocks import MAX_DETECTORS, Action, Comparison, Quantity
from rtcore.modes import Mode

ArmedMode = Annotated[Mode, ByName(Mode)]


class Detector(Document):
    """Watches one quantity, and acts once it has been beyond its threshold for long enough."""

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=40)
    quantity: Annotated[Quantity, ByName(Quantity)]
    comparison: Annotated[Comparison, ByName(Comparison)]
    threshold: float = Field(ge=-1e9, le=1e9, description="in the unit that the quantity ends in")
    persistence_s: float = Field(default=0.0, ge=0, le=60, description="0: trips at once")
    action: Annotated[Action, ByName(Action)]
    armed: tuple[ArmedMode, ...] = Field(min_length=1)
    enabled: bool = True

    @property
    def unit(self) -> str | None:
        """The unit of the threshold."""
        return unit_of(self.quantity.name.lower())

    def persistence_ticks(self, period_s: float) -> int:
        """How many ticks it must be violated, at least 1."""
        return max(1, round(self.persistence_s / period_s))


class Interlocks(Document):
    """All detectors; the first to trip is kept until reset."""

    detectors: tuple[Detector, ...] = Field(min_length=1, max_length=MAX_DETECTORS)

    @model_validator(mode="after")
    def _told_apart(self) -> Self:
        names = [detector.name for detector in self.detectors]
        twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
        if twice:
            raise wrong("detectors", f"two detectors are named {twice}", value=twice)
        return self
