"""What detectors watch and saw, in words for the operator: where the backend speaks in bar, mm and %."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from rtcore.interlocks import Comparison, Form, Quantity, SensorFault

_UNITS = ("_m_s", "_n", "_m", "_pa", "_s")


@dataclass(frozen=True)
class Words:
    """How a quantity is called, and how its values are written."""

    name: str
    scale: float = 1.0
    unit: str = ""
    decimals: int = 0

    def write(self, value: float) -> str:
        """A value with its unit: `142 bar`."""
        return self._written(value, self.unit)

    def write_rate(self, value: float) -> str:
        """What it changes by in a second: `3.1 mm/s`."""
        unit = {"": "1/s", "m/s": "m/s²"}.get(self.unit, f"{self.unit}/s")
        return self._written(value, unit)

    def _written(self, value: float, unit: str) -> str:
        if not math.isfinite(value):
            return "not a number" if math.isnan(value) else "infinite"
        number = f"{value * self.scale:,.{self.decimals}f}"
        if float(number.replace(",", "")) == 0.0 and value != 0.0:
            number = f"{value * self.scale:.1g}"  # a small limit is not "limit 0"
        return f"{number} {unit}".rstrip()


class _Named(Words):
    """Values that have names of their own, not numbers."""

    def write(self, value: float) -> str:
        if not math.isfinite(value):
            return "not a number"
        return _FAULTS.get(round(value), f"fault {value:g}")


_FAULTS = {int(fault): fault.name.lower().replace("_", " ") for fault in SensorFault} | {
    int(SensorFault.NONE): "sound",
    int(SensorFault.NOISE_FREE): "free of noise",
    int(SensorFault.IMPLAUSIBLE): "implausible beside the other sensors",
}


class _Chain(Words):
    def write(self, value: float) -> str:
        return "closed" if value == 0.0 else "open"


QUANTITIES: Mapping[Quantity, Words] = {
    Quantity.FORCE_N: Words("Force", 1.0, "N"),
    Quantity.FORCE_ERROR_N: Words("Force error", 1.0, "N"),
    Quantity.DISPLACEMENT_M: Words("Displacement", 1e3, "mm", 1),
    Quantity.VELOCITY_M_S: Words("Velocity", 1.0, "m/s", 2),
    Quantity.SUPPLY_PRESSURE_PA: Words("Supply pressure", 1e-5, "bar"),
    Quantity.LOAD_CELL: _Named("Load cell"),
    Quantity.APP_SILENCE_S: Words("Console silent for", 1.0, "s", 2),
    Quantity.DEADLINES_MISSED: Words("Deadlines missed at once"),
    Quantity.LVT: _Named("LVT"),
    Quantity.LVDT: _Named("LVDT"),
    Quantity.PRESSURE_SENSOR: _Named("Supply pressure sensor"),
    Quantity.FORCE_ERROR_RELATIVE: Words("Force error over the command's peak", 100.0, "%"),
    Quantity.UNDERPEAK: Words("Swing of the last cycle short by", 100.0, "%"),
    Quantity.VALVE_COMMAND: Words("Valve command", 100.0, "%"),
    Quantity.VALVE_SATURATION: Words("Valve at its limit for a share of", 100.0, "%"),
    Quantity.CYCLES: Words("Cycles of the run"),
    Quantity.TWIN_RESIDUAL_N: Words("Force beside the virtual rig's", 1.0, "N"),
    Quantity.TWIN_GOODNESS: Words("Agreement with the virtual rig", 1.0, "%"),
    Quantity.TWIN_SPOOL: Words("Spool off the virtual rig", 100.0, "%"),
    Quantity.UNRECORDED_S: Words("Samples not on the disk yet", 1.0, "s", 1),
    Quantity.CHAIN_OPEN: _Chain("Hard-wired chain"),
    Quantity.DISPLACEMENT_ERROR_M: Words("Displacement error", 1e3, "mm", 1),
    Quantity.PRESSURE_1_PA: Words("Pressure in chamber 1", 1e-5, "bar"),
    Quantity.PRESSURE_2_PA: Words("Pressure in chamber 2", 1e-5, "bar"),
}
NAMED = frozenset(q for q, words in QUANTITIES.items() if type(words) is not Words)


class Written(Protocol):
    """A detector as people write it."""

    @property
    def quantity(self) -> Quantity: ...
    @property
    def form(self) -> Form: ...
    @property
    def comparison(self) -> Comparison: ...
    @property
    def threshold(self) -> float: ...
    @property
    def low(self) -> float | None: ...
    @property
    def horizon_s(self) -> float | None: ...


@dataclass(frozen=True)
class Judging:
    """What of a detector decides how its values are told."""

    quantity: Quantity
    form: Form
    comparison: Comparison
    threshold: float
    low: float | None
    horizon_s: float | None

    @staticmethod
    def of_detector(d: Written) -> "Judging":
        """Of one as people write it."""
        return Judging(d.quantity, d.form, d.comparison, d.threshold, d.low, d.horizon_s)

    @staticmethod
    def of_record(detector: Any) -> "Judging":
        """Of a DETECTOR record."""
        return Judging(
            Quantity(int(detector["quantity"])),
            Form(int(detector["form"])),
            Comparison(int(detector["comparison"])),
            float(detector["threshold"]),
            float(detector["low"]),
            float(detector["horizon_s"]),
        )

    @property
    def words(self) -> Words:
        """Those of its quantity."""
        return QUANTITIES[self.quantity]

    def name(self) -> str:
        """`Force`, `Force rate`, `Force in 1 ms`."""
        if self.form is Form.RATE:
            return f"{self.words.name} rate"
        if self.form is Form.LOOK_AHEAD:
            return f"{self.words.name} in {1e3 * (self.horizon_s or 0.0):g} ms"
        return self.words.name

    def write(self, value: float) -> str:
        """A value that it judged."""
        rate = self.form is Form.RATE
        return self.words.write_rate(value) if rate else self.words.write(value)

    def allowed(self, limit: float | None = None) -> str:
        """`55,000 N`, of a band `-10 N … 20 N`; nothing of values that have names."""
        if self.quantity in NAMED:
            return ""
        threshold = self.write(self.threshold if limit is None else limit)
        band = self.comparison is Comparison.OUTSIDE and self.low is not None
        return f"{self.write(self.low or 0.0)} … {threshold}" if band else threshold

    def limit(self, limit: float | None = None) -> str:
        """`limit 55,000 N`, `limit at least 150 bar`, `limits -10 N … 20 N`; nothing of values that have names."""
        allowed = self.allowed(limit)
        if not allowed:
            return ""
        at_least = "at least " if self.comparison is Comparison.BELOW else ""
        word = "limits" if self.comparison is Comparison.OUTSIDE else "limit"
        return f"{word} {at_least}{allowed}"

    def reached(self, value: float) -> str:
        """A value as it is told: without its sign where that does not matter."""
        return self.write(abs(value) if self.comparison is Comparison.MAGNITUDE_ABOVE else value)


def trip_code(detector: Any) -> str:
    """A detector as a word for programs, its quantity without the unit: `force_error`, `force_rate`."""
    quantity = Quantity(int(detector["quantity"])).name.lower()
    unit = next((unit for unit in _UNITS if quantity.endswith(unit)), "")
    form = Form(int(detector["form"]))
    made = "" if form is Form.VALUE else f"_{form.name.lower()}"
    return f"{quantity.removesuffix(unit)}{made}"


def trip_text(detector: Any, value: float, limit: float, period_ns: int) -> str:
    """`Force error 6,120 N for 50 ms, limit 6,000 N`, `Load cell: frozen`."""
    judging = Judging.of_record(detector)
    between = ": " if judging.quantity in NAMED else " "
    persistence_ms = int(detector["persistence_ticks"]) * period_ns * 1e-6
    lasting = f" for {persistence_ms:,.0f} ms" if persistence_ms >= 1.0 else ""
    said = f"{judging.name()}{between}{judging.reached(value)}{lasting}"
    allowed = judging.limit(limit)
    return f"{said}, {allowed}" if allowed else said
