"""The closed loop's response at the sines of a test: how high, how low, how far, and within which bands."""

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from app.analysis.response.extremes import Extremes, find_extremes
from app.analysis.sines import FoundSine


class Required(NamedTuple):
    """Between which limits gain and phase are to stay from one frequency to another, in a block; None: any."""

    block: int
    from_hz: float
    to_hz: float
    low_db: float | None
    high_db: float | None
    low_deg: float | None
    high_deg: float | None

    def is_met(self, sine: FoundSine) -> bool:
        """Whether a sine within its frequencies is within its limits; NaN is not."""
        within_db = _within(gain_db(sine), self.low_db, self.high_db)
        return within_db and _within(sine.phase_deg, self.low_deg, self.high_deg)

    def concerns(self, sine: FoundSine) -> bool:
        return sine.block == self.block and self.from_hz <= sine.asked.frequency_hz <= self.to_hz


def gain_db(sine: FoundSine) -> float:
    """Amplitude over that of the setpoint."""
    ratio = sine.amplitude_n / sine.asked.amplitude_n
    return 20 * math.log10(ratio) if ratio > 0 else -math.inf if ratio == 0 else math.nan


def share_met(sines: Iterable[FoundSine], required: Sequence[Required]) -> float | None:
    """Share of the sines with a requirement that meet all of theirs; None where there is none."""
    met = []
    for sine in sines:
        limits = [one for one in required if one.concerns(sine)]
        if limits:
            met.append(all(one.is_met(sine) for one in limits))
    return sum(met) / len(met) if met else None


def least_of(sines: Iterable[FoundSine], read: Callable[[Extremes], float | None]) -> float | None:
    """The least of a corner frequency over amplitudes and means; None where no response has it."""
    found = (read(_extremes(series)) for series in _series(sines) if len(series) > 1)
    return min((value for value in found if value is not None), default=None)


def _series(sines: Iterable[FoundSine]) -> list[list[FoundSine]]:
    """Sines of the same block, amplitude asked for, and mean."""
    groups: dict[tuple[int, float, float], list[FoundSine]] = {}
    for sine in sines:
        key = sine.block, sine.asked.series_n, sine.asked.mean_n
        groups.setdefault(key, []).append(sine)
    return list(groups.values())


def _extremes(series: Sequence[FoundSine]) -> Extremes:
    response = [
        cmath.rect(sine.amplitude_n / sine.asked.amplitude_n, math.radians(sine.phase_deg))
        for sine in series
    ]
    return find_extremes([sine.asked.frequency_hz for sine in series], response)


def _within(value: float, low: float | None, high: float | None) -> bool:
    return (low is None or value >= low) and (high is None or value <= high) and value == value
