"""Time histories within a test: what force and motion have in common, and what the rig can follow of them."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from pydantic import Field, PrivateAttr

from app.definitions.checks import ROUNDING, exactly_one
from app.definitions.limits import RIG
from app.definitions.quantities import Gain, SampleRateHz, Times
from app.documents.fields import Document, wrong
from app.documents.units import say
from app.histories.history import Histories, History, from_values

HISTORIES = "histories"  # of the validation context: where files are looked up

FileName = Annotated[str, Field(min_length=1, max_length=255)]


class Reach(NamedTuple):
    """How far, how steeply and how fast a setpoint can be led: N, N/s or m, m/s, and Hz."""

    limit: float
    rate_per_s: float
    bandwidth_hz: float
    unit: str


class TimeCourse(Document):
    """Samples from a file or from the test itself, played with a monotone curve through them."""

    kind: Literal["time_history"] = "time_history"
    file: FileName | None = None
    rate_hz: SampleRateHz | None = None
    gain: Gain = 1.0
    repeats: Times = 1
    _history: History = PrivateAttr()

    @property
    def history(self) -> History:
        """The samples, before `gain`."""
        return self._history

    def _find(self, name: str, samples: Sequence[float] | None, reach: Reach, where: Any) -> None:
        """Take the samples from where they are; `name` is the key of those in the test itself."""
        exactly_one("file", self.file, name, samples)
        if samples is not None:
            self._history = _inline(samples, self.rate_hz)
        else:
            self._history = self._from_file(reach, where)
        _refuse_beyond("file" if self.file else name, self._history, self.gain, reach)

    def _from_file(self, reach: Reach, where: Mapping[str, Any] | None) -> History:
        source: Histories | None = (where or {}).get(HISTORIES)
        if source is None:
            raise wrong("file", "time histories in files cannot be read here", value=self.file)
        found = source.find(str(self.file), self.rate_hz)
        if isinstance(found, str):
            raise wrong("file", found, value=self.file)
        if found.unit not in (None, reach.unit):
            message = f"{self.file} is in {found.unit}, must be in {reach.unit}"
            raise wrong("file", message, value=found.unit)
        if self.rate_hz is not None and abs(self.rate_hz / found.rate_hz - 1) > 1e-6:
            own = say(found.rate_hz, "Hz")
            message = f"{self.file} is sampled at {own}: leave rate_hz out, or resample the file"
            raise wrong("rate_hz", message, value=self.rate_hz, limit=found.rate_hz, unit="Hz")
        return found


def _inline(samples: Sequence[float], rate_hz: float | None) -> History:
    if rate_hz is None:
        raise wrong("rate_hz", "rate_hz is needed for samples without times")
    return from_values(np.array(samples, np.float64), rate_hz)


def _refuse_beyond(field: str, history: History, gain: float, reach: Reach) -> None:
    """Refuse what the rig cannot follow, however it is led in."""
    found, unit, per_s = history.statistics, reach.unit, f"{reach.unit}/s"
    _at_most(field, "is sampled at", history.rate_hz, RIG.loop_rate_hz, "Hz", "")
    lasts_s = (found.samples - 1) / history.rate_hz
    _at_most(field, "lasts", lasts_s, RIG.duration_limit_s, "s", "")
    peak = max(abs(found.low), abs(found.high)) * abs(gain)
    _at_most(field, "reaches", peak, reach.limit, unit, "")
    steepest = found.steepest * history.rate_hz * abs(gain)
    at = f" at {say(found.steepest_at / history.rate_hz, 's')}"
    _at_most(field, "has to move at", steepest, reach.rate_per_s, per_s, at)
    band = history.bandwidth_hz
    _at_most(field, "holds frequencies up to", band, reach.bandwidth_hz, "Hz", " (99.9 % of it)")


def _at_most(field: str, does: str, value: float, limit: float, unit: str, where: str) -> None:
    if not value <= limit * ROUNDING:
        message = f"{does} {say(value, unit)}{where}, must be at most {say(limit, unit)}"
        raise wrong(field, message, value=value, limit=limit, unit=unit)
