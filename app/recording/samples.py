"""Reading samples back: a few columns of a stretch of a run, chunk by chunk, and its overview."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from threading import Lock
from typing import Protocol

import numpy as np
import pyarrow.parquet as pq

from app.recording.bins import Columns
from app.recording.columns import not_recorded
from app.recording.extent import Extent, extent_of
from app.recording.files import parquet_path, with_overview
from app.recording.live_overview import read_live_overview
from app.recording.overview import Level, overview_path, read_overview
from app.recording.parts import read_parts
from app.recording.recent import Recent

__all__ = ["Columns", "Levels", "Samples", "open_samples"]

Levels = tuple[Level, ...]  # finest first


class Samples(Protocol):
    """The recorded ticks of a run. `first_tick` and `last_tick` are those on disk."""

    first_tick: int
    last_tick: int

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """The columns `tick` and `names` between two ticks, both included, in order."""

    def levels(self) -> Levels:
        """Its overview; empty where there is none."""


class _File:
    """What is known of a Parquet file from its end: kept, for it takes longer than reading a window."""

    def __init__(self, path: Path) -> None:
        self.metadata = pq.read_metadata(path, memory_map=True)
        groups = [self.metadata.row_group(i) for i in range(self.metadata.num_row_groups)]
        column = self.metadata.schema.to_arrow_schema().get_field_index("tick")
        ends = [group.column(column).statistics for group in groups]
        self.first = np.array([int(end.min) for end in ends])
        self.last = np.array([int(end.max) for end in ends])
        rows = np.array([group.num_rows for group in groups])
        self.names = frozenset(self.metadata.schema.names)
        self.gapless = self.last - self.first + 1 == rows
        self.extent = Extent(int(self.first[0]), int(self.last[-1]), int(rows.sum()))


class ParquetSamples:
    """Of a run that is over: reads only the row groups and columns that are asked for.

    `mapped` is quickest for windows; of who goes through all of it, every page that was read would count
    as this program's memory.
    """

    def __init__(self, path: Path, *, mapped: bool = True) -> None:
        self._path = path
        self._mapped = mapped
        self._known = _files.get(path)
        self.first_tick = self._known.extent.first_tick
        self.last_tick = self._known.extent.last_tick

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        known = self._known
        wanted = [name for name in dict.fromkeys(names) if name != "tick" and name in known.names]
        lacking = [name for name in names if name not in known.names]
        start = int(np.searchsorted(known.last, first_tick))
        end = int(np.searchsorted(known.first, last_tick, side="right"))
        if start >= end:
            return
        with pq.ParquetFile(self._path, metadata=known.metadata, memory_map=self._mapped) as file:
            for i in range(start, end):
                with_ticks = wanted if known.gapless[i] and wanted else ["tick", *wanted]
                table = file.read_row_group(i, with_ticks, use_threads=False)
                columns = {name: table[name].to_numpy() for name in with_ticks}
                if "tick" not in columns:
                    columns["tick"] = np.arange(known.first[i], known.last[i] + 1)
                columns |= {name: not_recorded(name, len(columns["tick"])) for name in lacking}
                yield _between(columns, first_tick, last_tick)

    def levels(self) -> Levels:
        """Made from the samples where it is missing, and written where there is room for it."""
        found = _overview_of(self._path)
        if found is None:
            with _making:
                found = _overview_of(self._path)
                if found is None and _make_overview(self._path):
                    found = _overview_of(self._path)
        return found or ()


class PartSamples:
    """Of a run under way: what is whole in its parts now."""

    def __init__(self, folder: Path, extent: Extent) -> None:
        self._folder = folder
        self.first_tick = extent.first_tick
        self.last_tick = extent.last_tick

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        wanted = dict.fromkeys(["tick", *names])
        for batch in read_parts(self._folder, verify=False, from_tick=first_tick):
            if batch.column("tick")[0].as_py() > last_tick:
                return
            columns = {name: batch.column(name).to_numpy() for name in wanted}
            yield _between(columns, first_tick, last_tick)

    def levels(self) -> Levels:
        return read_live_overview(self._folder) or ()


def open_samples(folder: Path) -> Samples | None:
    """The samples in a run's folder, or None where there are none yet."""
    path = parquet_path(folder)
    if not path.exists():
        extent = extent_of(folder)
        if not path.exists():  # else the run ended while its parts were being read
            return PartSamples(folder, extent) if extent.ticks else None
    return ParquetSamples(path)


def _overview_of(path: Path) -> Levels | None:
    try:
        return _overviews.get(overview_path(path.parent, 0))
    except FileNotFoundError:
        return None


def _read(path: Path) -> Levels | None:
    folder = path.parent
    return read_overview(folder, _files.get(parquet_path(folder)).extent)


def _make_overview(path: Path) -> bool:
    try:
        with pq.ParquetFile(path, memory_map=True) as file:
            for _ in with_overview(path.parent, file.iter_batches(use_threads=False)):
                pass
    except OSError:  # no room, or not ours to write: then without
        return False
    return True


def _between(columns: Columns, first_tick: int, last_tick: int) -> Columns:
    ticks = columns["tick"]
    low = int(np.searchsorted(ticks, first_tick))
    high = int(np.searchsorted(ticks, last_tick, side="right"))
    return {name: values[low:high] for name, values in columns.items()}


_files: Recent[_File] = Recent(_File)
_overviews: Recent[Levels | None] = Recent(_read)
_making = Lock()
