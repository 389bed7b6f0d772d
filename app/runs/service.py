"""What can be asked about runs."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from app.db import Database
from app.errors import Code, Fault, Refusal
from app.recording.files import parquet_path
from app.recording.samples import open_samples
from app.runs import repository
from app.runs.envelope import Envelope, Floats, envelope
from app.runs.models import Run
from app.runs.schemas import (
    Band,
    RunDetail,
    RunEventOut,
    RunEvents,
    RunPage,
    RunSamples,
    RunSummary,
)
from rtcore.channels import CHANNEL


class Runs:
    """The runs of this data directory."""

    def __init__(self, database: Database, runs_dir: Path) -> None:
        self._database = database
        self._runs_dir = runs_dir

    def page(self, limit: int, before: int | None) -> RunPage:
        """The newest runs, or those before a number."""
        with self._database.reading() as session:
            runs = repository.page(session, limit + 1, before)
            shown = [RunSummary.of(run) for run in runs[:limit]]
        return RunPage(runs=shown, next=shown[-1].id if len(runs) > limit else None)

    def detail(self, run_id: int) -> RunDetail | Refusal:
        """A run with everything that it was made with."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            return _unknown(run_id) if run is None else RunDetail.of(run)

    def events(self, run_id: int) -> RunEvents | Refusal:
        """What the loop reported during a run."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            rows = repository.events(session, run_id)
            return RunEvents(events=[RunEventOut.of(row, run) for row in rows])

    def parquet(self, run_id: int) -> Path | Refusal:
        """The file of a run that is over."""
        run = self._row(run_id)
        if isinstance(run, Refusal):
            return run
        if run.outcome is None:
            return Refusal(Code.RUN_UNDER_WAY, f"Run {run_id} is still under way: wait for its end")
        path = parquet_path(self._runs_dir / str(run_id))
        return path if path.exists() else _no_data(run_id)

    def samples(
        self,
        run_id: int,
        channels: Sequence[str],
        from_s: float,
        to_s: float | None,
        points: int,
    ) -> RunSamples | Refusal:
        """Minimum and maximum of channels in at most `points` stretches of time."""
        names = list(dict.fromkeys(channels))
        unknown = [name for name in names if name not in CHANNEL]
        if unknown or not names:
            return _unknown_channels(unknown)
        run = self._row(run_id)
        if isinstance(run, Refusal):
            return run
        samples = open_samples(self._runs_dir / str(run_id))
        if samples is None:
            return _no_data(run_id)
        period_s = run.period_ns * 1e-9
        origin = samples.first_tick if run.first_tick is None else run.first_tick
        first = max(samples.first_tick, origin + _ticks(np.ceil(from_s / period_s - 1e-6)))
        last = samples.last_tick
        if to_s is not None:
            last = min(last, origin + _ticks(np.floor(to_s / period_s + 1e-6)))
        chunks = samples.chunks(names, first, last)
        return _shown(envelope(chunks, names, first, last, points), origin, last, period_s)

    def _row(self, run_id: int) -> Run | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            session.expunge(run)
            return run


def _ticks(count: float) -> int:
    """A number of ticks, kept within what a tick counter can hold."""
    return int(np.clip(count, -(2.0**53), 2.0**53))


def _shown(bands: Envelope, origin: int, last: int, period_s: float) -> RunSamples:
    times_s = ((bands.ticks - origin) * period_s).round(9).tolist()
    return RunSamples(
        from_s=times_s[0] if times_s else 0.0,
        to_s=max(0.0, (last - origin) * period_s),
        decimated=bands.bin_ticks > 1,
        time_s=times_s,
        channels={
            name: Band(min=_numbers(bands.low[name]), max=_numbers(bands.high[name]))
            for name in bands.low
        },
    )


def _numbers(values: Floats) -> list[float | None]:
    """JSON has neither NaN nor infinity: null."""
    return [value if np.isfinite(value) else None for value in values.tolist()]


def _unknown(run_id: int) -> Refusal:
    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")


def _no_data(run_id: int) -> Refusal:
    return Refusal(Code.NO_DATA, f"Run {run_id} has no samples")


def _unknown_channels(names: Sequence[str]) -> Refusal:
    known = f"one of {', '.join(CHANNEL)}"
    faults = tuple(Fault("query.channels", name, known) for name in names)
    shown = ", ".join(names) if names else "(none given)"
    return Refusal(Code.UNKNOWN_CHANNEL, f"Unknown channels: {shown}", faults)
