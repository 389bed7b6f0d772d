"""Where an axis has its ticks, and how they are written."""

import math
from typing import NamedTuple

_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)


class Axis(NamedTuple):
    """From where to where, with (value, text) of each tick in between."""

    low: float
    high: float
    ticks: tuple[tuple[float, str], ...]

    def share(self, value: float) -> float:
        """Where a value is: 0 at the low end, 1 at the high one."""
        return (value - self.low) / (self.high - self.low)


def axis(low: float, high: float, most: int, around: float = 0.0) -> Axis:
    """At most so many ticks, at round numbers; `around` is the share of the range left free at both ends."""
    if not (math.isfinite(low) and math.isfinite(high)):
        low, high = 0.0, 1.0
    spread = high - low
    if not spread > 1e-9 * max(abs(low), abs(high)):
        spread = 0.1 * abs(low) or 1.0
        low, high = low - 0.5 * spread, high + 0.5 * spread
    low, high = low - around * spread, high + around * spread
    step = _step((high - low) / most)
    places = max(0, -math.floor(math.log10(step) + 1e-9)) + (1 if _is_quarter(step) else 0)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    ticks = ((n * step, _written(n * step, places)) for n in range(first, last + 1))
    return Axis(low, high, tuple(ticks))


def _step(least: float) -> float:
    power = 10.0 ** math.floor(math.log10(least))
    return next(s * power for s in _STEPS if s * power >= least * (1 - 1e-9))


def _is_quarter(step: float) -> bool:
    lead = step / 10.0 ** math.floor(math.log10(step) + 1e-9)
    return abs(lead - 2.5) < 1e-6 and step < 10.0


def _written(value: float, places: int) -> str:
    written = f"{value:,.{places}f}"
    return ("0" if float(written.replace(",", "")) == 0.0 else written).replace("-", "−")
