"""What was predicted for a run: the prediction it started with, and the setpoint's answer on its own time."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow.parquet as pq

from app.analysis.walk import HOLD_FADE_S
from app.db import Database
from app.errors import Code, Refusal
from app.prediction.schemas import Prediction
from app.prediction.series_file import NAME
from app.recording.bins import Columns
from app.recording.samples import Levels
from app.runs import repository
from app.runs.envelope import Floats, envelope
from app.runs.models import RunEvent
from app.runs.predicted_schemas import PredictedBands
from rtcore.modes import Mode

COLUMNS = ("force_n", "displacement_m")


class Passage(NamedTuple):
    """Ticks of a run, from its first, in which its program went on: from `first` to before `end`."""

    first: int
    end: int
    shift: int  # from a tick of the program to that of the run


def passages(events: Sequence[RunEvent], first_tick: int, ticks: int, fade: int) -> list[Passage]:
    """Where in a run of so many ticks its program went on: a hold, and the fade after it, put it off.

    Once some of it has been skipped, sines have any other phase than was predicted: there it ends.
    """
    found: list[Passage] = []
    begun, shift, held_at = 0, 0, None
    for event in events:
        at = event.tick - first_tick
        if event.kind == "skipped":
            ticks = min(ticks, at)
            break
        if event.kind != "mode":
            continue
        if event.code == Mode.HOLDING.name.lower() and held_at is None:
            held_at = at
            found.append(Passage(begun, max(begun, at), shift))
        elif event.code == Mode.RUNNING.name.lower() and held_at is not None:
            again = at + min(at - held_at, fade) - 1
            shift += again - held_at
            begun, held_at = again, None
    if held_at is None:
        found.append(Passage(begun, max(begun, ticks), shift))
    return [passage for passage in found if passage.end > passage.first]


class PredictedSamples:
    """The predicted series of a run, by ticks of the run from its first."""

    def __init__(self, path: Path, where: Sequence[Passage]) -> None:
        self._path = path
        self._where = where
        self.first_tick = 0
        self.last_tick = max((passage.end for passage in where), default=0) - 1

    def levels(self) -> Levels:
        """None: it is short."""
        return ()

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """The columns `tick` and `names` between two ticks, both included, in order."""
        for first, end, shift in self._where:
            low, high = max(first, first_tick), min(end - 1, last_tick)
            if low <= high:
                yield from self._between(names, low - shift, high - shift, shift)

    def _between(
        self, names: Sequence[str], low: int, high: int, shift: int
    ) -> Iterator[dict[str, Floats]]:
        with pq.ParquetFile(self._path) as file:
            begin = 0
            for i in range(file.num_row_groups):
                rows = file.metadata.row_group(i).num_rows
                if begin <= high and begin + rows > low:  # program ticks are rows: 0, 1, 2 …
                    table = file.read_row_group(i, columns=list(names))
                    part = slice(max(0, low - begin), high - begin + 1)
                    ticks = np.arange(begin, begin + rows)[part] + shift
                    columns = {name: table[name].to_numpy()[part] for name in names}
                    yield {"tick": ticks, **columns}
                begin += rows


class RunPredictions:
    """What was predicted for the runs of this data directory."""

    def __init__(self, database: Database, runs_dir: Path) -> None:
        self._database = database
        self._runs_dir = runs_dir

    def prediction(self, run_id: int) -> Prediction | Refusal:
        """The prediction that a run was started with."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
            return _none(run_id) if not run.prediction else Prediction(**run.prediction)

    def bands(
        self, run_id: int, from_s: float, to_s: float | None, points: int
    ) -> PredictedBands | Refusal:
        """Least and greatest of what was predicted, in at most `points` stretches of the run's time."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
            period_s = run.period_ns * 1e-9
            path = self._runs_dir / str(run_id) / NAME
            if not path.exists():
                return _none(run_id)
            ticks = max(run.ticks, pq.read_metadata(path).num_rows)
            fade = round(HOLD_FADE_S / period_s)
            events = repository.events(session, run_id)
            where = passages(events, run.first_tick or 0, ticks, fade)
        samples = PredictedSamples(path, where)
        first = max(0, int(np.ceil(from_s / period_s - 1e-6)))
        last = samples.last_tick
        if to_s is not None:
            last = min(last, int(np.floor(to_s / period_s + 1e-6)))
        found = envelope(samples, COLUMNS, first, last, points)
        return PredictedBands(
            time_s=(found.ticks * period_s).round(9).tolist(),
            force_min_n=found.low["force_n"].tolist(),
            force_max_n=found.high["force_n"].tolist(),
            displacement_min_m=found.low["displacement_m"].tolist(),
            displacement_max_m=found.high["displacement_m"].tolist(),
        )


def _none(run_id: int) -> Refusal:
    return Refusal(Code.NO_DATA, f"Nothing was predicted for run {run_id}")
