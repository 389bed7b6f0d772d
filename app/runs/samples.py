"""The samples of a run, seen from afar or tick by tick."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from app.db import Database
from app.errors import Code, Fault, Refusal
from app.recording.samples import Samples, open_samples
from app.runs import repository
from app.runs.envelope import Envelope, Floats, envelope
from app.runs.no_data import no_data
from app.runs.schemas import Band, RunSamples
from rtcore.channels import CHANNEL


class RunWindows:
    """Windows of the runs of this data directory, under way or over."""

    def __init__(self, database: Database, runs_dir: Path) -> None:
        self._database = database
        self._runs_dir = runs_dir

    def window(
        self,
        run_id: int,
        channels: Sequence[str],
        from_s: float,
        to_s: float | None,
        points: int,
    ) -> RunSamples | Refusal:
        """Minimum and maximum of channels in at most `points` stretches of time."""
        names = known_channels(channels)
        if isinstance(names, Refusal):
            return names
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
            first_tick, period_s = run.first_tick, run.period_ns * 1e-9
            refusal = no_data(run)
        samples = open_samples(self._runs_dir / str(run_id))
        if samples is None:
            return refusal
        origin = samples.first_tick if first_tick is None else first_tick
        return window_of(samples, names, origin, period_s, from_s, to_s, points)


def known_channels(channels: Sequence[str]) -> list[str] | Refusal:
    """Names of channels, each once."""
    names = list(dict.fromkeys(channels))
    unknown = [name for name in names if name not in CHANNEL]
    return _unknown_channels(unknown) if unknown or not names else names


def window_of(
    samples: Samples,
    names: Sequence[str],
    origin: int,
    period_s: float,
    from_s: float,
    to_s: float | None,
    points: int,
) -> RunSamples:
    """Channels in at most `points` stretches between two times (s) from the tick `origin`."""
    first, last = _ticks_between(samples, origin, from_s, to_s, period_s)
    return _shown(envelope(samples, names, first, last, points), origin, last, period_s)


def _ticks_between(
    samples: Samples, origin: int, from_s: float, to_s: float | None, period_s: float
) -> tuple[int, int]:
    """The first and last tick of a window, both in it."""
    first = max(samples.first_tick, origin + _ticks(np.ceil(from_s / period_s - 1e-6)))
    if to_s is None:
        return first, samples.last_tick
    return first, min(samples.last_tick, origin + _ticks(np.floor(to_s / period_s + 1e-6)))


def _ticks(count: float) -> int:
    """A number of ticks, kept within what a tick counter can hold."""
    return int(np.clip(count, -(2.0**53), 2.0**53))


def _shown(bands: Envelope, origin: int, last: int, period_s: float) -> RunSamples:
    times_s = ((bands.ticks - origin) * period_s).round(9).tolist()
    return RunSamples(
        from_s=times_s[0] if times_s else 0.0,
        to_s=max(times_s[0] if times_s else 0.0, (last - origin) * period_s),
        decimated=bands.bin_ticks > 1,
        time_s=times_s,
        channels={
            name: Band(min=_numbers(bands.low[name]), max=_numbers(bands.high[name]))
            for name in bands.low
        },
    )


def _numbers(values: Floats) -> list[float | None]:
    """JSON has neither NaN nor infinity: null."""
    numbers: list[float | None] = values.tolist()
    for place in np.flatnonzero(~np.isfinite(values)).tolist():
        numbers[place] = None
    return numbers


def _unknown_channels(names: Sequence[str]) -> Refusal:
    known = f"one of {', '.join(CHANNEL)}"
    faults = tuple(Fault("query.channels", name, known) for name in names)
    shown = ", ".join(names) if names else "(none given)"
    return Refusal(Code.UNKNOWN_CHANNEL, f"Unknown channels: {shown}", faults)
