"""What figures show of a run's samples: bands of a long stretch, every tick of a short one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.recording.samples import Samples
from app.reports.figures.time import Trace
from app.reports.numbers import scale_of
from app.reports.subject import Subject
from app.runs.envelope import envelope
from rtcore.channels import CHANNEL

Floats = npt.NDArray[np.float64]
POINTS = 700  # as many as can be told apart on paper, nearly


@dataclass(frozen=True)
class View:
    """(n,) times (s) from the run's first tick; least and greatest of channels, in the units that are shown."""

    time_s: Floats
    low: dict[str, Floats]
    high: dict[str, Floats]

    def trace(self, name: str, label: str, colour: str, dash: str = "-") -> Trace:
        """A channel of it."""
        return Trace(label, self.time_s, self.low[name], self.high[name], colour, dash)


def view(
    subject: Subject,
    names: Sequence[str],
    from_s: float = 0.0,
    to_s: float | None = None,
    points: int = POINTS,
) -> View:
    """Channels between two times; of as many ticks as there are `points`, or fewer, every one."""
    assert subject.samples is not None
    return _view(subject.samples, subject, names, from_s, to_s, points)


def predicted_view(
    subject: Subject, from_s: float = 0.0, to_s: float | None = None, points: int = POINTS
) -> View | None:
    """The force that was predicted, likewise; None where nothing was."""
    if subject.predicted is None:
        return None
    first = subject.predicted.first_tick - subject.origin  # it counts from the run's first tick
    found = _view(subject.predicted, subject, ["force_n"], from_s, to_s, points, origin=0)
    return found if len(found.time_s) and first <= 0 else None


def _view(
    samples: Samples,
    subject: Subject,
    names: Sequence[str],
    from_s: float,
    to_s: float | None,
    points: int,
    origin: int | None = None,
) -> View:
    zero, period_s = subject.origin if origin is None else origin, subject.period_s
    first = max(samples.first_tick, zero + round(from_s / period_s))
    last = samples.last_tick
    if to_s is not None:
        last = min(last, zero + round(to_s / period_s))
    count = last - first + 1
    found = envelope(samples, names, first, last, count if count <= 3 * points else points)
    scales = {name: scale_of(CHANNEL[name].unit) for name in names}
    low = {name: found.low[name] * scales[name] for name in names}
    bands = found.bin_ticks > 1  # else both are the very same, and no band
    high = {name: found.high[name] * scales[name] for name in names} if bands else low
    times_s: Floats = (found.ticks - zero).astype(np.float64) * period_s
    return View(times_s, low, high)


def ticks_of(
    subject: Subject, names: Sequence[str], from_s: float, to_s: float
) -> dict[str, Floats]:
    """Every tick of channels between two times, in the units that are shown."""
    assert subject.samples is not None
    first = subject.origin + round(from_s / subject.period_s)
    last = subject.origin + round(to_s / subject.period_s)
    chunks = list(subject.samples.chunks(names, first, last))
    scales = {name: scale_of(CHANNEL[name].unit) for name in names}
    empty = np.empty(0)
    return {
        name: np.concatenate([empty, *(chunk[name] for chunk in chunks)]) * scales[name]
        for name in names
    }
