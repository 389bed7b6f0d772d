"""What the rig can show of each quantity: its unit, its reach, and which values can be made of it."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.documents.units import unit_of
from rtcore.interlocks import Form, Quantity


@dataclass(frozen=True)
class Reach:
    """The values that a quantity can take as it is; a threshold beyond them would never be passed.

    `flows` is whether it changes smoothly: a rate of anything else means nothing.
    """

    low: float | None
    high: float | None
    flows: bool = True


def _within(high: float, low: float | None = None, *, flows: bool = True) -> Reach:
    return Reach(-high if low is None else low, high, flows)


_WORD = _within(6.0, 0.0, flows=False)  # a SensorFault
_PRESSURE = _within(40e6, -0.2e6)  # what the sensors' converters reach

REACH: Mapping[Quantity, Reach] = {
    Quantity.FORCE_N: _within(60e3),
    Quantity.FORCE_ERROR_N: _within(
        110e3
    ),  # of the largest setpoint, the load cell at its other end
    Quantity.DISPLACEMENT_M: _within(0.035),
    Quantity.VELOCITY_M_S: _within(0.5),
    Quantity.SUPPLY_PRESSURE_PA: _PRESSURE,
    Quantity.LOAD_CELL: _WORD,
    Quantity.APP_SILENCE_S: Reach(0.0, None, flows=False),
    Quantity.DEADLINES_MISSED: Reach(0.0, None, flows=False),
    Quantity.LVT: _WORD,
    Quantity.LVDT: _WORD,
    Quantity.PRESSURE_SENSOR: _WORD,
    Quantity.FORCE_ERROR_RELATIVE: _within(110.0, 0.0),
    Quantity.UNDERPEAK: Reach(None, 1.0, flows=False),
    Quantity.VALVE_COMMAND: _within(1.0),
    Quantity.VALVE_SATURATION: _within(1.0, 0.0, flows=False),
    Quantity.CYCLES: Reach(0.0, None, flows=False),
    Quantity.TWIN_RESIDUAL_N: _within(120e3),
    Quantity.TWIN_GOODNESS: Reach(None, 100.0, flows=False),
    Quantity.UNRECORDED_S: Reach(0.0, None, flows=False),
    Quantity.CHAIN_OPEN: _within(1.0, 0.0, flows=False),
    Quantity.DISPLACEMENT_ERROR_M: _within(0.065),
    Quantity.PRESSURE_1_PA: _PRESSURE,
    Quantity.PRESSURE_2_PA: _PRESSURE,
    Quantity.TWIN_SPOOL: _within(2.5),
}

# Numbers without a unit in their names that people read with one.
_SHOWN_UNITS = {Quantity.TWIN_GOODNESS: "%"}


def unit_of_quantity(quantity: Quantity, form: Form = Form.VALUE) -> str | None:
    """The unit of a threshold: `N`, and `N/s` of a rate; None for a pure number."""
    unit = _SHOWN_UNITS.get(quantity) or unit_of(quantity.name.lower())
    if form is not Form.RATE:
        return unit
    return "1/s" if unit is None else "m/s²" if unit == "m/s" else f"{unit}/s"
