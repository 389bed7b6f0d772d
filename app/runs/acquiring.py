"""Which acquisitions a test asks for, ready to take its run."""

from collections.abc import Callable
from typing import Any, NamedTuple

from app.analysis.acquisition.cycles import LogarithmicCycles, PeakValley
from app.analysis.acquisition.intervals import MaxMin, Timed
from app.analysis.acquisition.table import Acquisition, measured_channels
from app.definitions.definition import Definition
from app.definitions.windows import stretches
from app.documents.units import say


class Asked(NamedTuple):
    """An acquisition of a test: what it is called, and how to begin it."""

    kind: str
    title: str
    begin: Callable[[float, int], Acquisition]  # from the period (s) and the run's first tick


def asked(definition: Definition) -> list[Asked]:
    """The acquisitions of a definition, in its order."""
    return [_ASKED[also.kind](definition, also) for also in definition.record.also]


def _channels(definition: Definition) -> tuple[str, ...]:
    return measured_channels(definition.record.channels)


def _timed(definition: Definition, also: Any) -> Asked:
    def begin(period_s: float, first_tick: int) -> Acquisition:
        return Timed(_channels(definition), also.rate_hz, period_s, first_tick)

    return Asked(also.kind, f"Timed, {say(also.rate_hz, 'Hz')}", begin)


def _max_min(definition: Definition, also: Any) -> Asked:
    def begin(period_s: float, first_tick: int) -> Acquisition:
        return MaxMin(_channels(definition), also.every_s, period_s, first_tick)

    return Asked(also.kind, f"Greatest and least, every {say(also.every_s, 's')}", begin)


def _peak_valley(definition: Definition, also: Any) -> Asked:
    def begin(period_s: float, first_tick: int) -> Acquisition:
        return PeakValley(stretches(definition), period_s, first_tick)

    return Asked(also.kind, "Peak and valley of each cycle", begin)


def _logarithmic(definition: Definition, also: Any) -> Asked:
    def begin(period_s: float, first_tick: int) -> Acquisition:
        channels = _channels(definition)
        return LogarithmicCycles(stretches(definition), channels, period_s, first_tick)

    return Asked(also.kind, "Cycles 1, 2, 5, 10, 20, 50 and so on", begin)


_ASKED: dict[str, Callable[[Definition, Any], Asked]] = {
    "timed": _timed,
    "peak_valley": _peak_valley,
    "max_min": _max_min,
    "logarithmic_cycles": _logarithmic,
}
