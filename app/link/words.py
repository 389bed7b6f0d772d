"""What detectors saw, in words for the operator: where the backend speaks in bar and mm."""

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from rtcore.interlocks import Comparison, Quantity, SensorFault

_UNITS = ("_m_s", "_n", "_m", "_pa", "_s")


class Words(NamedTuple):
    """How a quantity is called, and how its values are written."""

    name: str
    write: Callable[[float], str]


def _number(scale: float, unit: str, decimals: int = 0) -> Callable[[float], str]:
    def write(value: float) -> str:
        if not math.isfinite(value):
            return "not a number" if math.isnan(value) else "infinite"
        return f"{value * scale:,.{decimals}f} {unit}".rstrip()

    return write


def _sensor_fault(value: float) -> str:
    if value not in list(SensorFault):
        return "unknown fault"
    return SensorFault(int(value)).name.lower().replace("_", " ")


QUANTITIES: Mapping[Quantity, Words] = {
    Quantity.FORCE_N: Words("Force", _number(1.0, "N")),
    Quantity.FORCE_ERROR_N: Words("Force error", _number(1.0, "N")),
    Quantity.DISPLACEMENT_M: Words("Displacement", _number(1e3, "mm", 1)),
    Quantity.VELOCITY_M_S: Words("Velocity", _number(1.0, "m/s", 2)),
    Quantity.SUPPLY_PRESSURE_PA: Words("Supply pressure", _number(1e-5, "bar")),
    Quantity.APP_SILENCE_S: Words("Console silent for", _number(1.0, "s", 2)),
    Quantity.DEADLINES_MISSED: Words("Deadlines missed at once", _number(1.0, "")),
    Quantity.LOAD_CELL: Words("Load cell", _sensor_fault),
    Quantity.LVT: Words("LVT", _sensor_fault),
    Quantity.LVDT: Words("LVDT", _sensor_fault),
    Quantity.PRESSURE_SENSOR: Words("Supply pressure sensor", _sensor_fault),
    Quantity.FORCE_ERROR_RELATIVE: Words("Force error of the peak", _number(100.0, "%")),
    Quantity.UNDERPEAK: Words("Swing short by", _number(100.0, "%")),
    Quantity.VALVE_COMMAND: Words("Valve command", _number(100.0, "%")),
    Quantity.VALVE_SATURATION: Words("Valve at its limit for", _number(100.0, "% of the time")),
    Quantity.CYCLES: Words("Cycles", _number(1.0, "")),
    Quantity.TWIN_RESIDUAL_N: Words("Force off the virtual rig", _number(1.0, "N")),
    Quantity.TWIN_GOODNESS: Words("Agreement with the virtual rig", _number(1.0, "%", 1)),
    Quantity.UNRECORDED_S: Words("Not yet recorded", _number(1.0, "s", 1)),
    Quantity.CHAIN_OPEN: Words("Hard-wired chain", lambda value: "open" if value else "closed"),
    Quantity.DISPLACEMENT_ERROR_M: Words("Displacement error", _number(1e3, "mm", 1)),
    Quantity.PRESSURE_1_PA: Words("Pressure in chamber 1", _number(1e-5, "bar")),
    Quantity.PRESSURE_2_PA: Words("Pressure in chamber 2", _number(1e-5, "bar")),
}


def trip_code(detector: Any) -> str:
    """A detector as a word for programs, its quantity without the unit: `force_error`."""
    quantity = Quantity(int(detector["quantity"])).name.lower()
    unit = next((unit for unit in _UNITS if quantity.endswith(unit)), "")
    return quantity.removesuffix(unit)


def trip_text(detector: Any, value: float, limit: float, period_ns: int) -> str:
    """`Force error 6,120 N for 50 ms, limit 6,000 N`."""
    words = QUANTITIES[Quantity(int(detector["quantity"]))]
    shown = abs(value) if int(detector["comparison"]) == Comparison.MAGNITUDE_ABOVE else value
    persistence_ms = int(detector["persistence_ticks"]) * period_ns * 1e-6
    lasting = f" for {persistence_ms:,.0f} ms" if persistence_ms >= 1.0 else ""
    at_least = "at least " if int(detector["comparison"]) == Comparison.BELOW else ""
    return f"{words.name} {words.write(shown)}{lasting}, limit {at_least}{words.write(limit)}"
