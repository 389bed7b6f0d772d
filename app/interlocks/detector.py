"""A detector: what it watches, how it judges that, what it does about it, and what it tells the operator."""

from typing import Annotated

from pydantic import Field

from app.db import NO_NUL
from app.documents.fields import Document
from app.interlocks.names import ByName
from app.interlocks.quantities import unit_of_quantity
from rtcore.interlocks import Action, Comparison, Form, Quantity
from rtcore.modes import Mode

Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=40)]
ArmedMode = Annotated[Mode, ByName(Mode)]
_GONE = {
    "sensor_faults": "each sensor has a detector of its own now: load_cell, lvt, lvdt, pressure_sensor"
}
_Limit = Annotated[float, Field(ge=-1e9, le=1e9)]


class Detector(Document):
    """Watches one quantity, and acts once what it makes of that has been beyond a limit for long enough."""

    name: Name
    quantity: Annotated[Quantity, ByName(Quantity, _GONE)]
    form: Annotated[Form, ByName(Form)] = Form.VALUE
    comparison: Annotated[Comparison, ByName(Comparison)]
    threshold: _Limit = Field(description="in the unit of the quantity; of a rate, that per second")
    low: _Limit | None = Field(default=None, description="of a band, its lower end")
    horizon_s: float | None = Field(default=None, gt=0, le=1, description="of a look-ahead")
    smoothing_s: float | None = Field(default=None, gt=0, le=10, description="of the rate")
    persistence_s: float = Field(default=0.0, ge=0, le=60, description="0: trips at once")
    action: Annotated[Action, ByName(Action)]
    armed: tuple[ArmedMode, ...] = Field(min_length=1)
    latching: bool = Field(default=True, description="a stop and a shutdown always latch")
    enabled: bool = True
    text: str = Field(default="", max_length=500, pattern=NO_NUL, description="for the operator")

    @property
    def unit(self) -> str | None:
        """The unit of the threshold."""
        return unit_of_quantity(self.quantity, self.form)

    def persistence_ticks(self, period_s: float) -> int:
        """How many ticks it must be violated, at least 1."""
        return max(1, round(self.persistence_s / period_s))
