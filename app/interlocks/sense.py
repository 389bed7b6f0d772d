"""What of a detector contradicts itself, or could never be seen on this rig."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from pydantic_core import PydanticCustomError

from app.documents.fields import wrong
from app.documents.units import say
from app.interlocks.quantities import REACH, unit_of_quantity
from rtcore.interlocks import Action, Comparison, Form

if TYPE_CHECKING:
    from app.interlocks.detector import Detector

Faults = Iterator[PydanticCustomError]


def faults_of(detector: "Detector") -> Faults:
    """Everything that makes no sense in a detector, each at its key."""
    for rule in _RULES:
        yield from rule(detector)


def _band(d: "Detector") -> Faults:
    if d.comparison is not Comparison.OUTSIDE:
        if d.low is not None:
            message = "only a band has a lower end: compare with outside, or leave it out"
            yield wrong("low", message, value=d.low)
    elif d.low is None:
        yield wrong("low", "a band needs its lower end: outside is below low or above threshold")
    elif not d.low < d.threshold:
        unit = unit_of_quantity(d.quantity, d.form)
        message = f"{say(d.low, unit)} must be below the threshold, {say(d.threshold, unit)}"
        yield wrong("low", message, value=d.low, limit=d.threshold, unit=unit)


def _magnitude(d: "Detector") -> Faults:
    if d.comparison is Comparison.MAGNITUDE_ABOVE and d.threshold < 0:
        message = "a magnitude is never below 0: this would always trip"
        yield wrong("threshold", message, value=d.threshold, limit=0.0)


def _latch(d: "Detector") -> Faults:
    if d.action >= Action.STOP and not d.latching:
        word = d.action.name.lower()
        message = f"a {word} always latches: somebody has to look before the rig goes on"
        yield wrong("latching", message, value=False)


def _form(d: "Detector") -> Faults:
    if d.form is not Form.VALUE and not REACH[d.quantity].flows:
        message = (
            f"{d.quantity.name.lower()} does not change smoothly: only its value can be watched"
        )
        yield wrong("form", message, value=d.form.name.lower())


def _horizon(d: "Detector") -> Faults:
    if d.form is Form.LOOK_AHEAD and d.horizon_s is None:
        yield wrong("horizon_s", "a look-ahead needs a horizon: how long before it is crossed")
    elif d.form is not Form.LOOK_AHEAD and d.horizon_s is not None:
        yield wrong("horizon_s", "only a look-ahead has a horizon", value=d.horizon_s, unit="s")


def _smoothing(d: "Detector") -> Faults:
    if d.form is Form.VALUE and d.smoothing_s is not None:
        message = "only a rate or a look-ahead is smoothed"
        yield wrong("smoothing_s", message, value=d.smoothing_s, unit="s")


def _within_reach(d: "Detector") -> Faults:
    """What cannot be read cannot trip. Rates and look-aheads have no such bounds."""
    reach, form = REACH[d.quantity], d.form
    if form is not Form.VALUE:
        return
    unit = unit_of_quantity(d.quantity)
    if d.comparison is Comparison.BELOW:
        yield from _too_low("threshold", d.threshold, reach.low, unit)
    else:
        yield from _too_high("threshold", d.threshold, reach.high, unit)
    if d.comparison is Comparison.OUTSIDE and d.low is not None:
        yield from _too_low("low", d.low, reach.low, unit)


def _too_high(field: str, value: float, highest: float | None, unit: str | None) -> Faults:
    if highest is not None and value >= highest:
        message = (
            f"{say(value, unit)} would never be passed: {say(highest, unit)} is all there can be"
        )
        yield wrong(field, message, value=value, limit=highest, unit=unit)


def _too_low(field: str, value: float, lowest: float | None, unit: str | None) -> Faults:
    if lowest is not None and value <= lowest:
        message = f"{say(value, unit)} would never be passed: {say(lowest, unit)} is the least there can be"
        yield wrong(field, message, value=value, limit=lowest, unit=unit)


_RULES: tuple[Callable[["Detector"], Faults], ...] = (
    _band,
    _magnitude,
    _latch,
    _form,
    _horizon,
    _smoothing,
    _within_reach,
)
