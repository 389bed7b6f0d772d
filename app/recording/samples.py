"""Reading samples back: a few columns of a stretch of a run, chunk by chunk."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq

from app.recording.files import parquet_path
from app.recording.parts import read_parts

Columns = dict[str, npt.NDArray[Any]]


class Samples(Protocol):
    """The recorded ticks of a run. `first_tick` and `last_tick` are those on disk."""

    first_tick: int
    last_tick: int

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        """The columns `tick` and `names` between two ticks, both included, in order."""


class ParquetSamples:
    """Of a run that is over: reads only the row groups and columns that are asked for."""

    def __init__(self, path: Path) -> None:
        self._file = pq.ParquetFile(path)
        groups = [self._file.metadata.row_group(i) for i in range(self._file.num_row_groups)]
        column = self._file.schema_arrow.get_field_index("tick")
        statistics = [group.column(column).statistics for group in groups]
        self._extents = [(int(s.min), int(s.max)) for s in statistics]
        self.first_tick, self.last_tick = self._extents[0][0], self._extents[-1][1]

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        wanted = list(dict.fromkeys(["tick", *names]))
        for i, (low, high) in enumerate(self._extents):
            if low <= last_tick and high >= first_tick:
                table = self._file.read_row_group(i, wanted)
                yield _between({n: table[n].to_numpy() for n in wanted}, first_tick, last_tick)


class PartSamples:
    """Of a run under way: what is whole in its parts now."""

    def __init__(self, batches: Sequence[Any]) -> None:
        self._batches = batches
        self.first_tick = batches[0].column("tick")[0].as_py()
        self.last_tick = batches[-1].column("tick")[-1].as_py()

    def chunks(self, names: Sequence[str], first_tick: int, last_tick: int) -> Iterator[Columns]:
        for batch in self._batches:
            ticks = batch.column("tick")
            if ticks[0].as_py() <= last_tick and ticks[-1].as_py() >= first_tick:
                columns = {n: batch.column(n).to_numpy() for n in {"tick", *names}}
                yield _between(columns, first_tick, last_tick)


def open_samples(folder: Path) -> Samples | None:
    """The samples in a run's folder, or None where there are none yet."""
    path = parquet_path(folder)
    if not path.exists():
        batches = list(read_parts(folder, verify=False))
        if not path.exists():  # else the run ended while its parts were being read
            return PartSamples(batches) if batches else None
    return ParquetSamples(path)


def _between(columns: Columns, first_tick: int, last_tick: int) -> Columns:
    ticks = columns["tick"]
    low = int(np.searchsorted(ticks, first_tick))
    high = int(np.searchsorted(ticks, last_tick, side="right"))
    return {name: values[low:high] for name, values in columns.items()}
